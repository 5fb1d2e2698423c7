// A column notices before it is finished that the file does not hold what it was given.
#include "portraits/output_column.h"

#include "engine/base/error.h"
#include "portraits/stored_grid.h"
#include "tests/portraits/sample.h"
#include "tests/portraits/scratch.h"

namespace portrait {
namespace {

class Column : public ScratchTest {};

TEST_F(Column, OtherValuesInTheFileAreNoticed) {
  const Grid grid = sample::grid_of({2500});
  const TileRows rows(grid);
  h5::File file = h5::File::create(in("p.h5"));
  write_grid(file, grid);
  OutputColumn status = OutputColumn::of_status(file, grid);
  for (std::uint64_t tile = 0; tile < rows.tile_count(); ++tile)
    status.write(tile, std::vector<std::byte>(rows.range(tile).count, std::byte{1}));
  const Box box = rows.box(1);
  file.dataset("status").write(box.start, box.extent, std::vector<std::byte>(box.size(), std::byte{2}).data());
  EXPECT_EQ(message_of<StoreError>([&] { status.finish(file, file.dataset("kappa")); }),
            in("p.h5").string() + ": status does not hold what was written to tile 1");
  file.abandon();
}

}  // namespace
}  // namespace portrait
