#include "engine/measures/catalogue.h"

#include <limits>

namespace portrait {
namespace {

constexpr std::string_view kIae = "integral of |w - y| from 0 to the horizon, w the unfiltered setpoint";
constexpr std::string_view kIse = "integral of (w - y)^2 from 0 to the horizon, w the unfiltered setpoint";
constexpr std::string_view kItae = "integral of t |w - y| from 0 to the horizon, w the unfiltered setpoint";
constexpr std::string_view kItse = "integral of t (w - y)^2 from 0 to the horizon, w the unfiltered setpoint";
constexpr std::string_view kTv = "sum of |increments| from 0- to the horizon, the jump at 0+ included";
constexpr std::string_view kTv0 = "total variation less |x(inf) - x(0-)|: deviation from a monotonic response";
constexpr std::string_view kTv1 = "total variation less that of the best shape with at most one extreme";
constexpr std::string_view kTv2 =
    "total variation less that of the best shape with at most two extremes, alternating about x(inf)";
constexpr std::string_view kMax = "largest |x(t)| from 0 to the horizon";

constexpr std::string_view kTvm =
    "total variation less that of the best shape with at most so many extremes, alternating about x(inf)";
constexpr std::string_view kIaeOfY = "integral of |y| from 0 to the horizon";
constexpr std::string_view kIseOfY = "integral of y^2 from 0 to the horizon";
constexpr std::string_view kItaeOfY = "integral of t |y| from 0 to the horizon";
constexpr std::string_view kItseOfY = "integral of t y^2 from 0 to the horizon";
constexpr std::string_view kClass =
    "number of extremes alternately above and below x(inf) by more than 1 % of the largest deviation from it";
constexpr std::string_view kNoisy =
    "mean over the seeds of the measure of this name, of the signal at the instants k Ts; noise grows with the "
    "step";
constexpr std::string_view kSpread = "standard deviation over the seeds of what stands before it";
constexpr std::string_view kSigma =
    "mean over the seeds of the RMS of u per RMS of the noise, at the instants of the second half of the horizon";

constexpr std::array<MeasureInfo, kMeasureCount> kMeasures = {{
    {"IAE_w", "integral of absolute error, setpoint step", kIae, Unit::output_time, 'w'},
    {"IAE_d", "integral of absolute error, disturbance step", kIae, Unit::output_time, 'd'},
    {"ISE_w", "integral of squared error, setpoint step", kIse, Unit::output2_time, 'w'},
    {"ISE_d", "integral of squared error, disturbance step", kIse, Unit::output2_time, 'd'},
    {"ITAE_w", "integral of time times absolute error, setpoint step", kItae, Unit::output_time2, 'w'},
    {"ITAE_d", "integral of time times absolute error, disturbance step", kItae, Unit::output_time2, 'd'},
    {"ITSE_w", "integral of time times squared error, setpoint step", kItse, Unit::output2_time2, 'w'},
    {"ITSE_d", "integral of time times squared error, disturbance step", kItse, Unit::output2_time2, 'd'},
    {"TV_yw", "total variation of y, setpoint step", kTv, Unit::output, 'w'},
    {"TV0_yw", "deviation of y from monotonicity, setpoint step", kTv0, Unit::output, 'w'},
    {"TV1_yw", "deviation of y from a one-pulse shape, setpoint step", kTv1, Unit::output, 'w'},
    {"TV2_yw", "deviation of y from a two-pulse shape, setpoint step", kTv2, Unit::output, 'w'},
    {"TV_uw", "total variation of u, setpoint step", kTv, Unit::input, 'w'},
    {"TV0_uw", "deviation of u from monotonicity, setpoint step", kTv0, Unit::input, 'w'},
    {"TV1_uw", "deviation of u from a one-pulse shape, setpoint step", kTv1, Unit::input, 'w'},
    {"TV2_uw", "deviation of u from a two-pulse shape, setpoint step", kTv2, Unit::input, 'w'},
    {"TV_yd", "total variation of y, disturbance step", kTv, Unit::output, 'd'},
    {"TV0_yd", "deviation of y from monotonicity, disturbance step", kTv0, Unit::output, 'd'},
    {"TV1_yd", "deviation of y from a one-pulse shape, disturbance step", kTv1, Unit::output, 'd'},
    {"TV2_yd", "deviation of y from a two-pulse shape, disturbance step", kTv2, Unit::output, 'd'},
    {"TV_ud", "total variation of u, disturbance step", kTv, Unit::input, 'd'},
    {"TV0_ud", "deviation of u from monotonicity, disturbance step", kTv0, Unit::input, 'd'},
    {"TV1_ud", "deviation of u from a one-pulse shape, disturbance step", kTv1, Unit::input, 'd'},
    {"TV2_ud", "deviation of u from a two-pulse shape, disturbance step", kTv2, Unit::input, 'd'},
    {"y_max_w", "largest |y|, setpoint step; overshoot is y_max_w - 1", kMax, Unit::output, 'w'},
    {"u_max_w", "largest |u|, setpoint step", kMax, Unit::input, 'w'},
    {"y_max_d", "largest |y|, disturbance step", kMax, Unit::output, 'd'},
    {"u_max_d", "largest |u|, disturbance step", kMax, Unit::input, 'd'},
    {"Ms", "peak of the sensitivity", "sup over omega > 0 of |1/(1 + L(j omega))|", Unit::one, '-'},
    {"Mt", "peak of the complementary sensitivity", "sup over omega > 0 of |L/(1 + L)|", Unit::one, '-'},
    {"Ms_omega", "frequency of the peak of the sensitivity",
     "omega at which |1/(1 + L(j omega))| is largest, in radians; 0 or inf for its limit there", Unit::per_time,
     '-'},
    {"Mt_omega", "frequency of the peak of the complementary sensitivity",
     "omega at which |L/(1 + L)| is largest, in radians; 0 or inf for its limit there", Unit::per_time, '-'},
    {"GM", "gain margin", "smallest factor above 1 on L at which the loop loses stability", Unit::one, '-'},
    {"GM_low", "lower gain margin", "largest factor below 1 on L at which the loop loses stability; 0: none does",
     Unit::one, '-'},
    {"PM", "phase margin", "smallest |arg(-L(j omega))| where |L| = 1; inf where |L| is never 1", Unit::degree,
     '-'},
    {"DM", "delay margin", "smallest further dead time at which the loop loses stability; inf: none does",
     Unit::time, '-'},
    {"noise_gain", "amplification of measurement noise",
     "RMS of u per RMS of white measurement noise held over the sampling time; inf for an ideal derivative",
     Unit::input_per_output, '-'},
    {"TV3_yw", "deviation of y from a three-pulse shape, setpoint step", kTvm, Unit::output, 'w'},
    {"TV4_yw", "deviation of y from a four-pulse shape, setpoint step", kTvm, Unit::output, 'w'},
    {"TV5_yw", "deviation of y from a five-pulse shape, setpoint step", kTvm, Unit::output, 'w'},
    {"TV6_yw", "deviation of y from a six-pulse shape, setpoint step", kTvm, Unit::output, 'w'},
    {"TV7_yw", "deviation of y from a seven-pulse shape, setpoint step", kTvm, Unit::output, 'w'},
    {"TV8_yw", "deviation of y from an eight-pulse shape, setpoint step", kTvm, Unit::output, 'w'},
    {"TV3_uw", "deviation of u from a three-pulse shape, setpoint step", kTvm, Unit::input, 'w'},
    {"TV4_uw", "deviation of u from a four-pulse shape, setpoint step", kTvm, Unit::input, 'w'},
    {"TV5_uw", "deviation of u from a five-pulse shape, setpoint step", kTvm, Unit::input, 'w'},
    {"TV6_uw", "deviation of u from a six-pulse shape, setpoint step", kTvm, Unit::input, 'w'},
    {"TV7_uw", "deviation of u from a seven-pulse shape, setpoint step", kTvm, Unit::input, 'w'},
    {"TV8_uw", "deviation of u from an eight-pulse shape, setpoint step", kTvm, Unit::input, 'w'},
    {"TV3_yd", "deviation of y from a three-pulse shape, disturbance step", kTvm, Unit::output, 'd'},
    {"TV4_yd", "deviation of y from a four-pulse shape, disturbance step", kTvm, Unit::output, 'd'},
    {"TV5_yd", "deviation of y from a five-pulse shape, disturbance step", kTvm, Unit::output, 'd'},
    {"TV6_yd", "deviation of y from a six-pulse shape, disturbance step", kTvm, Unit::output, 'd'},
    {"TV7_yd", "deviation of y from a seven-pulse shape, disturbance step", kTvm, Unit::output, 'd'},
    {"TV8_yd", "deviation of y from an eight-pulse shape, disturbance step", kTvm, Unit::output, 'd'},
    {"TV3_ud", "deviation of u from a three-pulse shape, disturbance step", kTvm, Unit::input, 'd'},
    {"TV4_ud", "deviation of u from a four-pulse shape, disturbance step", kTvm, Unit::input, 'd'},
    {"TV5_ud", "deviation of u from a five-pulse shape, disturbance step", kTvm, Unit::input, 'd'},
    {"TV6_ud", "deviation of u from a six-pulse shape, disturbance step", kTvm, Unit::input, 'd'},
    {"TV7_ud", "deviation of u from a seven-pulse shape, disturbance step", kTvm, Unit::input, 'd'},
    {"TV8_ud", "deviation of u from an eight-pulse shape, disturbance step", kTvm, Unit::input, 'd'},
    {"IAE_o", "integral of absolute error, output step", kIaeOfY, Unit::output_time, 'o'},
    {"ISE_o", "integral of squared error, output step", kIseOfY, Unit::output2_time, 'o'},
    {"ITAE_o", "integral of time times absolute error, output step", kItaeOfY, Unit::output_time2, 'o'},
    {"ITSE_o", "integral of time times squared error, output step", kItseOfY, Unit::output2_time2, 'o'},
    {"TV_yo", "total variation of y, output step", kTv, Unit::output, 'o'},
    {"TV0_yo", "deviation of y from monotonicity, output step", kTv0, Unit::output, 'o'},
    {"TV1_yo", "deviation of y from a one-pulse shape, output step", kTv1, Unit::output, 'o'},
    {"TV2_yo", "deviation of y from a two-pulse shape, output step", kTv2, Unit::output, 'o'},
    {"TV3_yo", "deviation of y from a three-pulse shape, output step", kTvm, Unit::output, 'o'},
    {"TV4_yo", "deviation of y from a four-pulse shape, output step", kTvm, Unit::output, 'o'},
    {"TV5_yo", "deviation of y from a five-pulse shape, output step", kTvm, Unit::output, 'o'},
    {"TV6_yo", "deviation of y from a six-pulse shape, output step", kTvm, Unit::output, 'o'},
    {"TV7_yo", "deviation of y from a seven-pulse shape, output step", kTvm, Unit::output, 'o'},
    {"TV8_yo", "deviation of y from an eight-pulse shape, output step", kTvm, Unit::output, 'o'},
    {"TV_uo", "total variation of u, output step", kTv, Unit::input, 'o'},
    {"TV0_uo", "deviation of u from monotonicity, output step", kTv0, Unit::input, 'o'},
    {"TV1_uo", "deviation of u from a one-pulse shape, output step", kTv1, Unit::input, 'o'},
    {"TV2_uo", "deviation of u from a two-pulse shape, output step", kTv2, Unit::input, 'o'},
    {"TV3_uo", "deviation of u from a three-pulse shape, output step", kTvm, Unit::input, 'o'},
    {"TV4_uo", "deviation of u from a four-pulse shape, output step", kTvm, Unit::input, 'o'},
    {"TV5_uo", "deviation of u from a five-pulse shape, output step", kTvm, Unit::input, 'o'},
    {"TV6_uo", "deviation of u from a six-pulse shape, output step", kTvm, Unit::input, 'o'},
    {"TV7_uo", "deviation of u from a seven-pulse shape, output step", kTvm, Unit::input, 'o'},
    {"TV8_uo", "deviation of u from an eight-pulse shape, output step", kTvm, Unit::input, 'o'},
    {"y_max_o", "largest |y|, output step", kMax, Unit::output, 'o'},
    {"u_max_o", "largest |u|, output step", kMax, Unit::input, 'o'},
    {"DC_yw", "dynamic class of y, setpoint step", kClass, Unit::one, 'w'},
    {"DC_uw", "dynamic class of u, setpoint step", kClass, Unit::one, 'w'},
    {"DC_yd", "dynamic class of y, disturbance step", kClass, Unit::one, 'd'},
    {"DC_ud", "dynamic class of u, disturbance step", kClass, Unit::one, 'd'},
    {"DC_yo", "dynamic class of y, output step", kClass, Unit::one, 'o'},
    {"DC_uo", "dynamic class of u, output step", kClass, Unit::one, 'o'},
    {"noisy_TV_yw", "mean total variation of y under noise, setpoint step", kNoisy, Unit::output, 'w'},
    {"spread_TV_yw", "spread of the total variation of y under noise, setpoint step", kSpread, Unit::output, 'w'},
    {"noisy_TV0_yw", "mean deviation of y from monotonicity under noise, setpoint step", kNoisy, Unit::output, 'w'},
    {"spread_TV0_yw", "spread of the deviation of y from monotonicity under noise, setpoint step", kSpread,
     Unit::output, 'w'},
    {"noisy_TV1_yw", "mean deviation of y from a one-pulse shape under noise, setpoint step", kNoisy, Unit::output,
     'w'},
    {"spread_TV1_yw", "spread of the deviation of y from a one-pulse shape under noise, setpoint step", kSpread,
     Unit::output, 'w'},
    {"noisy_TV2_yw", "mean deviation of y from a two-pulse shape under noise, setpoint step", kNoisy, Unit::output,
     'w'},
    {"spread_TV2_yw", "spread of the deviation of y from a two-pulse shape under noise, setpoint step", kSpread,
     Unit::output, 'w'},
    {"noisy_TV_uw", "mean total variation of u under noise, setpoint step", kNoisy, Unit::input, 'w'},
    {"spread_TV_uw", "spread of the total variation of u under noise, setpoint step", kSpread, Unit::input, 'w'},
    {"noisy_TV0_uw", "mean deviation of u from monotonicity under noise, setpoint step", kNoisy, Unit::input, 'w'},
    {"spread_TV0_uw", "spread of the deviation of u from monotonicity under noise, setpoint step", kSpread,
     Unit::input, 'w'},
    {"noisy_TV1_uw", "mean deviation of u from a one-pulse shape under noise, setpoint step", kNoisy, Unit::input,
     'w'},
    {"spread_TV1_uw", "spread of the deviation of u from a one-pulse shape under noise, setpoint step", kSpread,
     Unit::input, 'w'},
    {"noisy_TV2_uw", "mean deviation of u from a two-pulse shape under noise, setpoint step", kNoisy, Unit::input,
     'w'},
    {"spread_TV2_uw", "spread of the deviation of u from a two-pulse shape under noise, setpoint step", kSpread,
     Unit::input, 'w'},
    {"noisy_TV_yd", "mean total variation of y under noise, disturbance step", kNoisy, Unit::output, 'd'},
    {"spread_TV_yd", "spread of the total variation of y under noise, disturbance step", kSpread, Unit::output,
     'd'},
    {"noisy_TV0_yd", "mean deviation of y from monotonicity under noise, disturbance step", kNoisy, Unit::output,
     'd'},
    {"spread_TV0_yd", "spread of the deviation of y from monotonicity under noise, disturbance step", kSpread,
     Unit::output, 'd'},
    {"noisy_TV1_yd", "mean deviation of y from a one-pulse shape under noise, disturbance step", kNoisy,
     Unit::output, 'd'},
    {"spread_TV1_yd", "spread of the deviation of y from a one-pulse shape under noise, disturbance step", kSpread,
     Unit::output, 'd'},
    {"noisy_TV2_yd", "mean deviation of y from a two-pulse shape under noise, disturbance step", kNoisy,
     Unit::output, 'd'},
    {"spread_TV2_yd", "spread of the deviation of y from a two-pulse shape under noise, disturbance step", kSpread,
     Unit::output, 'd'},
    {"noisy_TV_ud", "mean total variation of u under noise, disturbance step", kNoisy, Unit::input, 'd'},
    {"spread_TV_ud", "spread of the total variation of u under noise, disturbance step", kSpread, Unit::input, 'd'},
    {"noisy_TV0_ud", "mean deviation of u from monotonicity under noise, disturbance step", kNoisy, Unit::input,
     'd'},
    {"spread_TV0_ud", "spread of the deviation of u from monotonicity under noise, disturbance step", kSpread,
     Unit::input, 'd'},
    {"noisy_TV1_ud", "mean deviation of u from a one-pulse shape under noise, disturbance step", kNoisy,
     Unit::input, 'd'},
    {"spread_TV1_ud", "spread of the deviation of u from a one-pulse shape under noise, disturbance step", kSpread,
     Unit::input, 'd'},
    {"noisy_TV2_ud", "mean deviation of u from a two-pulse shape under noise, disturbance step", kNoisy,
     Unit::input, 'd'},
    {"spread_TV2_ud", "spread of the deviation of u from a two-pulse shape under noise, disturbance step", kSpread,
     Unit::input, 'd'},
    {"sigma_ratio", "mean amplification of the noise that is drawn", kSigma, Unit::input_per_output, '-'},
    {"spread_sigma_ratio", "spread of the amplification of the noise that is drawn", kSpread,
     Unit::input_per_output, '-'},
    {"expected_sigma_ratio", "expected amplification of noise at the instants",
     "RMS of u at the instants k Ts, just after the noise has changed, per RMS of the noise: exact, no noise is "
     "drawn",
     Unit::input_per_output, '-'},
}};

}  // namespace

const MeasureInfo& info(Measure measure) { return kMeasures[static_cast<std::size_t>(measure)]; }

std::optional<Measure> measure_named(std::string_view name) {
  for (std::size_t i = 0; i < kMeasureCount; ++i)
    if (kMeasures[i].name == name) return static_cast<Measure>(i);
  return std::nullopt;
}

double& MeasureRow::further(std::size_t i) {
  if (further_.empty())
    further_.assign(kMeasureCount - kStandardMeasureCount, std::numeric_limits<double>::quiet_NaN());
  return further_[i];
}

}  // namespace portrait
