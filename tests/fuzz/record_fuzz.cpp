/// Recorded responses from any bytes: read, judged, and fitted by everything that takes one.
#include <cmath>
#include <cstdint>
#include <string>

#include "engine/base/check.h"
#include "engine/base/error.h"
#include "engine/records/plant_fit.h"
#include "engine/records/record_areas.h"

namespace portrait {
namespace {

using namespace records;

/// Each of these may refuse what it is given, by its own words.
template <typename Work>
void tried(const Work& work) {
  try {
    work();
  } catch (const InputError& error) {
    PORTRAIT_CHECK(std::string(error.what()).size() > 5);
  }
}

void check(const Record& record) {
  PORTRAIT_CHECK(record.t.size() == record.u.size() && record.t.size() == record.y.size());
  for (std::size_t i = 0; i < record.size(); ++i) {
    PORTRAIT_CHECK(std::isfinite(record.t[i]) && std::isfinite(record.u[i]) && std::isfinite(record.y[i]));
    PORTRAIT_CHECK(i == 0 || record.t[i] > record.t[i - 1]);
  }
  tried([&] { PORTRAIT_CHECK(std::isfinite(quality(record).start)); });
  tried([&] { measured_reaction_curve(record); });
  tried([&] { PORTRAIT_CHECK(self_regulating_areas(record, 4, record.t.back()).areas.size() >= 4); });
  tried([&] { PORTRAIT_CHECK(integrating_areas(record, 4, record.t.back()).areas.size() >= 4); });
  if (record.size() > 12) return;  // fits search: seconds on long records
  for (const Plant family : {Plant::dipdt, Plant::ipdt, Plant::fotd})
    tried([&] {
      const RealPlant plant = fitted_plant(record, family, false).plant;
      PORTRAIT_CHECK(!why_invalid(plant));
    });
}

}  // namespace
}  // namespace portrait

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace portrait;
  const std::string text(reinterpret_cast<const char*>(bytes), size);
  try {
    const records::Record record = records::read_record(text, "fuzz");
    if (record.size() > 0) check(record);
  } catch (const InputError& error) {
    PORTRAIT_CHECK(std::string(error.what()).rfind("fuzz", 0) == 0);
  }
  return 0;
}
