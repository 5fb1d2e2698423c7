/// The page's questions as paths of its server: body in, PageAnswers asked, answer or refusal out.
///
///     200  the answer          400  a request that does not fit, {"error": "why"}          500  a failure, {"error": "what"}
///
/// tests     tests/tools/hostile_test.py, tests/tools/page/page_threads_test.cpp, tests/fuzz/http_fuzz.cpp
#pragma once

#include "tools/page/connections.h"
#include "tools/page_answers.h"

namespace portrait::tools {

/// POST /api/info, /view, /setting, /simulate, /front, /rules and /quantiles. REQUIRES: `answers` outlives the server.
void add_routes(page::LoopbackServer& server, const PageAnswers& answers);

/// GET / and the files that the page is made of.
void add_assets(page::LoopbackServer& server);

}  // namespace portrait::tools
