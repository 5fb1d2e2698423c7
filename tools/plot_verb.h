/// The kinds of `portrait plot`, each added to the verb as a command of its own.
#pragma once

#include "tools/verbs.h"

namespace portrait::tools {

// plot_portrait.cpp, plot_front.cpp: of a portrait
void add_plot_map(CLI::App& plot, Invocation& invocation);
void add_plot_front(CLI::App& plot, Invocation& invocation);
// plot_loops.cpp: of single loops
void add_plot_responses(CLI::App& plot, Invocation& invocation);
void add_plot_nyquist(CLI::App& plot, Invocation& invocation);
void add_plot_bars(CLI::App& plot, Invocation& invocation);
// plot_characteristic.cpp: of families of loops
void add_plot_characteristic(CLI::App& plot, Invocation& invocation);
// plot_stability.cpp
void add_plot_stability(CLI::App& plot, Invocation& invocation);

}  // namespace portrait::tools
