// A portrait appears whole or not at all, and never in the place of another one.
#include <chrono>
#include <cstdlib>
#include <thread>

#include "engine/base/check.h"
#include "engine/base/error.h"
#include "portraits/reader.h"
#include "portraits/verify.h"
#include "tests/portraits/sample.h"
#include "tests/portraits/scratch.h"

namespace portrait {
namespace {

class Publish : public ScratchTest {
 protected:
  void TearDown() override {
    unsetenv("SOURCE_DATE_EPOCH");
    ScratchTest::TearDown();
  }
};

const Provenance kProvenance{.command_line = "portrait sweep sample.toml", .method = "sample"};

TEST_F(Publish, ExistingFileIsRefusedAndUntouched) {
  put_bytes(in("p.h5"), "somebody's work");
  EXPECT_EQ(message_of<InputError>([&] { sample::write(in("p.h5"), sample::small_grid()); }),
            in("p.h5").string() + " exists already (--force replaces it)");
  EXPECT_EQ(bytes_of(in("p.h5")), "somebody's work");
  EXPECT_EQ(files_in_folder(), 1u);
}

TEST_F(Publish, ExistingFileIsRefusedBeforeAnyWork) {
  put_bytes(in("p.h5"), "somebody's work");
  EXPECT_THROW(PortraitWriter(in("p.h5"), sample::small_grid(), kProvenance), InputError);
}

TEST_F(Publish, FileThatCameMeanwhileIsRefusedAndUntouched) {
  const Grid grid = sample::small_grid();
  {
    PortraitWriter writer(in("p.h5"), grid, kProvenance);
    writer.write(writer.encode(0, sample::columns(grid, 0)));
    put_bytes(in("p.h5"), "somebody's work");
    EXPECT_EQ(message_of<InputError>([&] { writer.publish({}); }),
              in("p.h5").string() + " exists already (--force replaces it)");
  }
  EXPECT_EQ(bytes_of(in("p.h5")), "somebody's work");
  EXPECT_EQ(files_in_folder(), 1u);
}

TEST_F(Publish, ReplacesWhenTold) {
  put_bytes(in("p.h5"), "somebody's work");
  sample::write(in("p.h5"), sample::small_grid(), Existing::replace);
  EXPECT_EQ(PortraitReader(in("p.h5")).settings(), 12u);
  EXPECT_EQ(files_in_folder(), 1u);
}

TEST_F(Publish, NothingHasTheNameBeforeAndNothingIsLeftWithout) {
  const Grid grid = sample::grid_of({10000});
  {
    PortraitWriter writer(in("p.h5"), grid, kProvenance);
    writer.write(writer.encode(0, sample::columns(grid, 0)));
    EXPECT_EQ(writer.tiles_left(), 2u);
    EXPECT_FALSE(std::filesystem::exists(in("p.h5")));
  }
  EXPECT_EQ(files_in_folder(), 0u);
}

TEST_F(Publish, PublishingWithTilesLeftIsOurMistake) {
  const Grid grid = sample::grid_of({10000});
  PortraitWriter writer(in("p.h5"), grid, kProvenance);
  writer.write(writer.encode(0, sample::columns(grid, 0)));
  EXPECT_THROW(writer.publish({}), BrokenPromise);
  EXPECT_THROW(writer.write(writer.encode(0, sample::columns(grid, 0))), BrokenPromise) << "a tile written twice";
  EXPECT_THROW(writer.write(writer.encode(2, sample::columns(grid, 2))), BrokenPromise) << "a tile left out";
  EXPECT_THROW(writer.write(writer.encode(1, sample::columns(sample::grid_of({7}), 0))), BrokenPromise)
      << "a tile of another size";
}

TEST_F(Publish, TwoWritersOfOneNameDoNotMeet) {
  const Grid grid = sample::small_grid();
  PortraitWriter first(in("p.h5"), grid, kProvenance), second(in("p.h5"), grid, kProvenance);
  first.write(first.encode(0, sample::columns(grid, 0)));
  second.write(second.encode(0, sample::columns(grid, 0)));
  first.publish({});
  EXPECT_THROW(second.publish({}), InputError);
  EXPECT_NO_THROW(verify(in("p.h5")));
}

TEST_F(Publish, MissingFolderIsNamed) {
  EXPECT_EQ(message_of<InputError>([&] { sample::write(in("none") / "p.h5", sample::small_grid()); }),
            (in("none") / "p.h5").string() + ": there is no directory " + in("none").string());
}

TEST_F(Publish, UnwritableFolderIsNamedWithTheSystemsWords) {
  const std::string message =
      message_of<StoreError>([&] { sample::write("/proc/portrait-test.h5", sample::small_grid()); });
  EXPECT_NE(message.find("/proc/portrait-test.h5.tmp-"), std::string::npos) << message;
  EXPECT_NE(message.find(": cannot open the file to write to it: No such file or directory"), std::string::npos)
      << message;
}

/// Every chunk is asked for where it was put: HDF5 has no checksum on its index.
TEST_F(Publish, AFileWithoutItsChunksIsNotPublished) {
  const Grid grid = sample::small_grid();
  {
    PortraitWriter writer(in("p.h5"), grid, kProvenance);
    writer.write(writer.encode(0, sample::columns(grid, 0)));
    std::filesystem::remove(writer.temporary_path());
    EXPECT_THROW(writer.publish({}), StoreError);
  }
  EXPECT_EQ(files_in_folder(), 0u);
}

TEST_F(Publish, DateOfSourceDateEpoch) {
  setenv("SOURCE_DATE_EPOCH", "1700000000", 1);
  sample::write(in("p.h5"), sample::small_grid());
  EXPECT_EQ(PortraitReader(in("p.h5")).facts().date_created, "2023-11-14T22:13:20Z");
  EXPECT_EQ(PortraitReader(in("p.h5")).facts().history, "2023-11-14T22:13:20Z portrait sweep sample.toml");
}

TEST_F(Publish, SameBytesWithTheSameDate) {
  setenv("SOURCE_DATE_EPOCH", "1700000000", 1);
  sample::write(in("first.h5"), sample::grid_of({37, 100}));
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // HDF5 would keep times in seconds
  sample::write(in("second.h5"), sample::grid_of({37, 100}));
  EXPECT_EQ(bytes_of(in("first.h5")), bytes_of(in("second.h5")));
}

TEST_F(Publish, SourceDateEpochMustBeSeconds) {
  for (const char* wrong : {"yesterday", "", "-1", "1700000000s", "999999999999999999"}) {
    setenv("SOURCE_DATE_EPOCH", wrong, 1);
    EXPECT_EQ(message_of<InputError>([&] { date_text(); }),
              "SOURCE_DATE_EPOCH must be a number of seconds since 1970 (it is \"" + std::string(wrong) + "\")");
  }
}

}  // namespace
}  // namespace portrait
