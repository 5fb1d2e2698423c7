// Files that are no portraits, or of another time, are refused with a plain sentence.
#include "engine/base/error.h"
#include "portraits/h5.h"
#include "portraits/reader.h"
#include "portraits/verify.h"
#include "tests/portraits/sample.h"
#include "tests/portraits/scratch.h"

namespace portrait {
namespace {

class Foreign : public ScratchTest {
 protected:
  std::string refusal() const {
    return message_of<InputError>([&] { PortraitReader portrait(in("p.h5")); });
  }
  std::string named(const std::string& sentence) const { return in("p.h5").string() + ": " + sentence; }

  h5::File new_hdf5() const {
    put_bytes(in("p.h5"), "");
    return h5::File::create_behind(in("p.h5"), 512);
  }

  void write_hdf5(const std::string& schema_name, const std::string& schema_version) const {
    h5::File file = new_hdf5();
    file.set_text("schema_name", schema_name);
    file.set_text("schema_version", schema_version);
    file.close();
  }
};

TEST_F(Foreign, NoFile) { EXPECT_EQ(refusal(), named("there is no such file")); }

TEST_F(Foreign, Folder) {
  std::filesystem::create_directory(in("p.h5"));
  EXPECT_EQ(refusal(), named("this is not a file"));
}

TEST_F(Foreign, EmptyFileAndText) {
  for (const char* text : {"", "kappa,tau_i,IAE_w\n", "\x89HDF\r\n\x1a"}) {
    put_bytes(in("p.h5"), text);
    EXPECT_EQ(refusal(), named("this is no portrait: it is not an HDF5 file"));
  }
}

TEST_F(Foreign, OtherHdf5) {
  write_hdf5("landscape", "1.0.0");
  EXPECT_EQ(refusal(),
            named("this is an HDF5 file, but no portrait: its attribute schema_name does not say \"portrait\""));
}

TEST_F(Foreign, Hdf5WithoutAttributes) {
  new_hdf5().close();
  EXPECT_EQ(refusal(),
            named("this is an HDF5 file, but no portrait: its attribute schema_name does not say \"portrait\""));
}

TEST_F(Foreign, NewerFormat) {
  write_hdf5("portrait", "3.1.0");
  const std::string sentence = "this portrait has format 3.1.0; this program reads format 2.x: use a newer program";
  EXPECT_EQ(refusal(), named(sentence));
  EXPECT_EQ(message_of<InputError>([&] { verify(in("p.h5")); }), named(sentence));
}

TEST_F(Foreign, FormatThatIsNoVersion) {
  write_hdf5("portrait", "new");
  EXPECT_EQ(refusal(), named("this portrait has format new; this program reads format 2.x"));
}

TEST_F(Foreign, PortraitWithoutItsAttributesIsBroken) {
  write_hdf5("portrait", "2.0.0");
  EXPECT_EQ(message_of<IntegrityError>([&] { PortraitReader portrait(in("p.h5")); }),
            named("attribute title is missing"));
}

}  // namespace
}  // namespace portrait
