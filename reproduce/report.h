/// Reproduced tables as Markdown: docs/reproductions.md is this text.
#pragma once

#include <string>
#include <vector>

#include "reproduce/reproduction.h"

namespace portrait::reproduce {

/// A number as it stands beside a printed one: two digits more than that has.
std::string beside(const std::string& published, double ours);

/// One table, with its conditions and the reasons for what differs.
std::string markdown(const Reproduction& made);

/// All of them, behind a summary by paper.
std::string markdown(const std::vector<Reproduction>& all);

}  // namespace portrait::reproduce
