/// portrait plot: pictures for papers and reports, as SVG, PDF or PNG.

#include "tools/plot_verb.h"

namespace portrait::tools {
namespace {

constexpr const char* kHelp =
    R"(Example:
  portrait plot map huba.h5 --minimize 'IAE_w + IAE_d' --where 'TV2_ud <= 0.1' -o map.svg
  portrait plot responses huba.h5 --minimize IAE_d --where 'Ms <= 2' -o responses.pdf
  portrait plot nyquist --plant dipdt --setting 'QRDP: kappa=0.1248 tau_i=10.324 delta=0.5045' -o L.png

Draws a picture for a paper or a report with gnuplot, SVG, PDF or PNG by the name of the
file. The command that drew it is kept in the picture's metadata.)";

}  // namespace

void add_plot(CLI::App& app, Invocation& invocation) {
  CLI::App* verb = add_verb(app, "plot", "pictures for papers and reports", kHelp);
  verb->require_subcommand(1);
  add_plot_map(*verb, invocation);
  add_plot_responses(*verb, invocation);
  add_plot_nyquist(*verb, invocation);
  add_plot_bars(*verb, invocation);
  add_plot_front(*verb, invocation);
  add_plot_characteristic(*verb, invocation);
  add_plot_stability(*verb, invocation);
}

}  // namespace portrait::tools
