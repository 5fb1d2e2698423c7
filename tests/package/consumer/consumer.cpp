// consumer FILE.h5: measures one loop, then asks a portrait for its best setting.
#include <cstdio>

#include "engine/loop/parameters.h"
#include "engine/rules/catalogue.h"
#include "engine/sweep/method.h"
#include "portraits/query/query.h"
#include "portraits/reader.h"

int main(int count, char** words) {
  using namespace portrait;
  if (count != 2) return 2;
  const LoopFamily family{.plant = Plant::dipdt, .n = 0, .prefilter = Prefilter::pi};
  const Setting setting{.kappa = 0.24, .tau_i = 8, .delta = 0.7};
  SettingMeasured measured;
  measure_settings(Method::kernel, family, Horizon::fixed(40), {}, {&setting, 1}, {&measured, 1});
  std::printf("IAE_w %.6f\n", measured.measures[Measure::IAE_w]);

  const PortraitReader portrait(words[1]);
  const Answer answer = ask(portrait, Question{.minimize = parse_expression({"objective", "IAE_w + IAE_d"}), .conditions = {}});
  std::printf("best %s\n", setting_text({portrait.grid().family, answer.top.at(0).setting}).c_str());
  std::printf("rules %zu\n", rules::catalogue().size());
  return 0;
}
