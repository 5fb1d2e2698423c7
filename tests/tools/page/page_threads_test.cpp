// The page's server with many clients at once: each gets the answer that it gets alone, and bytes that are no request
// from others in between change nothing.
#include <atomic>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "tests/portraits/sample.h"
#include "tests/portraits/scratch.h"
#include "tools/page_routes.h"

namespace portrait::tools {
namespace {

struct Asked {
  const char *path, *body;
};
constexpr Asked kQuestions[] = {
    {"/api/info", "{}"},
    {"/api/view", R"({"x": "kappa", "y": "tau_i", "held": [0, 0], "minimize": "IAE_w", "colour": "Ms"})"},
    {"/api/view", R"({"x": "tau_i", "y": "kappa", "held": [0, 0], "minimize": "Ms", "colour": "IAE_w"})"},
    {"/api/view", R"({"minimize": "IAE_"})"},
    {"/api/setting", R"({"number": 3, "expressions": ["IAE_w", "Ms"]})"},
    {"/api/simulate", R"({"number": 5})"},
    {"/api/front", R"({"x_expression": "IAE_w", "y_expression": "TV2_uw"})"},
    {"/api/rules", R"({"minimize": "IAE_w"})"},
    {"/api/quantiles", R"({"expression": "IAE_w + Ms"})"},
};

class PageThreads : public ScratchTest {
 protected:
  void SetUp() override {
    ScratchTest::SetUp();
    sample::write(in("p.h5"), sample::small_grid());
    answers_.emplace(in("p.h5").string(), 1'000);  // no column fits twice: they leave while others read them
    add_routes(server_, *answers_);
    port_ = server_.bind(0);
    serving_ = std::thread([&] { server_.serve(); });
    while (!server_.is_running()) std::this_thread::yield();
  }
  void TearDown() override {
    server_.stop_serving();
    serving_.join();
    ScratchTest::TearDown();
  }

  /// Status and body.
  std::string answer(httplib::Client& client, const Asked& question) const {
    const httplib::Result result = client.Post(question.path, question.body, "application/json");
    return result ? std::to_string(result->status) + result->body : "no answer: " + httplib::to_string(result.error());
  }
  std::string answer(const Asked& question) const {
    httplib::Client client("127.0.0.1", port_);
    return answer(client, question);
  }

  void send_nonsense(const std::string& bytes) const {
    const int s = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port_));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ASSERT_EQ(::connect(s, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    EXPECT_GT(::send(s, bytes.data(), bytes.size(), MSG_NOSIGNAL), 0);
    ::close(s);
  }

  page::LoopbackServer server_;
  int port_ = 0;

 private:
  std::optional<PageAnswers> answers_;
  std::thread serving_;
};

TEST_F(PageThreads, GiveEachClientItsAnswer) {
  std::vector<std::string> alone;
  for (const Asked& question : kQuestions) alone.push_back(answer(question));
  EXPECT_EQ(alone[3].substr(0, 3), "400");
  EXPECT_EQ(alone[7].substr(0, 3), "200");
  std::vector<std::string> differs(6);
  std::vector<std::thread> clients;
  for (std::size_t k = 0; k < differs.size(); ++k)
    clients.emplace_back([&, k] {
      httplib::Client client("127.0.0.1", port_);
      client.set_keep_alive(k % 2 == 0);
      for (std::size_t round = 0; round < 30; ++round) {
        const std::size_t q = (round * (k + 1) + k) % std::size(kQuestions);
        const std::string now = answer(client, kQuestions[q]);
        if (now != alone[q]) differs[k] += kQuestions[q].path + (": " + now.substr(0, 200)) + "\n";
      }
    });
  for (int round = 0; round < 30; ++round) send_nonsense(round % 2 == 0 ? "G" : "POST /api/info HTTP/1.1\r\n\r\n{");
  for (std::thread& client : clients) client.join();
  for (const std::string& text : differs) EXPECT_EQ(text, "");
}

/// Accepted before the end, begun after it: it would be waited for until its client has been idle for long enough.
TEST(OpenConnections, EndsThoseThatComeTooLate) {
  int ends[2];
  ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
  page::OpenConnections open;
  open.end_all();
  open.opened(ends[0]);
  char byte = 0;
  EXPECT_EQ(::recv(ends[1], &byte, 1, MSG_DONTWAIT), 0) << "the other side sees the end";
  open.close(ends[0]);
  ::close(ends[1]);
}

TEST_F(PageThreads, EndWhileClientsStillTalk) {
  std::atomic<bool> ended = false;
  std::vector<std::thread> clients;
  std::atomic<int> answered = 0;
  for (int k = 0; k < 4; ++k)
    clients.emplace_back([&] {
      httplib::Client client("127.0.0.1", port_);
      client.set_keep_alive(true);
      while (!ended)
        if (client.Post("/api/info", "{}", "application/json")) ++answered;
    });
  while (answered < 20) std::this_thread::yield();
  server_.stop_serving();
  ended = true;
  for (std::thread& client : clients) client.join();
  EXPECT_GE(answered, 20);
}

}  // namespace
}  // namespace portrait::tools
