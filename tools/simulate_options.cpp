#include "tools/simulate_options.h"

namespace portrait::tools {

void add_loop_options(CLI::App& verb, SimulateArguments& a) {
  verb.add_option("--plant", a.plant, "dipdt, ipdt, fotd, jotd, or tf:NUM/DEN, highest power first")->required();
  verb.add_option("--kappa", a.kappa, "controller gain");
  verb.add_option("--tau-i", a.tau_i, "integral time Ti/Td; inf, the default: no integral action");
  verb.add_option("--delta", a.delta, "derivative gain, kappa tau_d");
  verb.add_option("--tau-d", a.tau_d, "derivative time TD/Td, instead of --delta");
  verb.add_option("--tau-1", a.tau_1, "plant time constant T1/Td (fotd)");
  verb.add_option("--j", a.j, "number of equal lags, 1 to 8 (jotd)");
  verb.add_option("--tau-j", a.tau_j, "their time constant Tj/Td (jotd)");
  verb.add_option("--tau-f", a.tau_f, "filter time constant Tf/Td");
  verb.add_option("--n", a.n, "filter order; 0: ideal derivative of the output")->check(CLI::NonNegativeNumber);
  verb.add_option("--prefilter", a.prefilter,
                  "full, pi, none or tf:NUM/DEN (default with --kappa: pi for n = 0, else full; else none)");
  verb.add_option("--b", a.b, "prefilter numerator, coefficient of s")->capture_default_str();
  verb.add_option("--c", a.c, "prefilter numerator, coefficient of s^2")->capture_default_str();
  verb.add_option("--K", a.K, "plant gain (default 1)");
  verb.add_option("--Td", a.Td, "dead time (default 1; tf: 0); all times then are in its unit");
  verb.add_option("--pid", a.pid, "standard:Kc=,Ti=,TD= or series:Kc=,Ti=,TD= or parallel:Kp=,Ki=,Kd=");
  verb.add_option("--gains", a.gains, "K_-1,K_0,..,K_m, with --tau-f and --n");
  verb.add_option("--controller", a.controller, "tf:NUM/DEN");
  verb.add_option("--weights", a.weights, "setpoint weights b=,c= of the proportional and derivative action");
}

}  // namespace portrait::tools
