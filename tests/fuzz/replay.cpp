/// replay CORPUS [MUTANTS [SEED]]: gives every input of a corpus file to the target, in place of libFuzzer, and then so many
/// mutants of them, drawn at random without an eye on coverage. A line is an input, with \xNN for bytes that are no printable
/// ASCII and for the backslash. When the target fails, the last input stands in the file `last_input` of the working folder,
/// if there are mutants.
#include <cstddef>
#include <cstdint>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);

namespace {

std::string unescaped(const std::string& line) {
  std::string bytes;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] != '\\' || i + 3 >= line.size()) {
      bytes += line[i];
      continue;
    }
    bytes += static_cast<char>(std::stoi(line.substr(i + 2, 2), nullptr, 16));
    i += 3;
  }
  return bytes;
}

constexpr char kSigns[] = "0123456789.,-+eE/=:;\"\n []{}";

/// One of the usual changes: a bit, a byte, a piece taken out, doubled, or put in from another input.
void change(std::string& input, const std::vector<std::string>& corpus, std::mt19937_64& random) {
  const auto below = [&](std::size_t count) { return static_cast<std::size_t>(random() % (count + 1)); };
  const std::size_t at = below(input.size()), length = below(8);
  const std::string& other = corpus[below(corpus.size() - 1)];
  switch (random() % 7) {
    case 0:
      if (at < input.size()) input[at] = static_cast<char>(input[at] ^ (1 << random() % 8));
      break;
    case 1:
      if (at < input.size()) input[at] = static_cast<char>(random());
      break;
    case 2:
      input.erase(at, length);
      break;
    case 3:
      input.insert(at, input.substr(at, length));
      break;
    case 4:
      input.insert(at, 1, kSigns[random() % (sizeof kSigns - 1)]);
      break;
    case 5:
      input.insert(at, other.substr(below(other.size()), length));
      break;
    default:
      input = input.substr(0, at) + other.substr(below(other.size()));
  }
}

std::string* last_input = nullptr;

/// Only what may be called in a signal handler would be safe; the process ends anyway, and the input is worth the try.
void keep_last_input() {
  if (last_input != nullptr) std::ofstream("last_input", std::ios::binary) << *last_input;
}
extern "C" void failed(int signal) {
  keep_last_input();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void give(const std::string& bytes) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

void give_mutants(const std::vector<std::string>& corpus, unsigned long long count, unsigned long long seed) {
  constexpr std::size_t kLongest = 512;
  std::mt19937_64 random(seed);
  std::string input;
  last_input = &input;
  for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL}) std::signal(signal, failed);
  for (; count > 0; --count) {
    input = corpus[random() % corpus.size()];
    for (auto changes = 1 + random() % 6; changes > 0; --changes) change(input, corpus, random);
    if (input.size() > kLongest) input.resize(kLongest);
    give(input);
  }
}

}  // namespace

int main(int count, char** words) {
  std::ifstream file(count >= 2 && count <= 4 ? words[1] : "");
  if (!file) {
    std::cerr << "replay: no corpus\n";
    return 2;
  }
  std::vector<std::string> corpus;
  for (std::string line; std::getline(file, line);) corpus.push_back(unescaped(line));
  if (corpus.empty()) return 1;
  for (const std::string& input : corpus) give(input);
  const unsigned long long mutants = count > 2 ? std::strtoull(words[2], nullptr, 10) : 0;
  give_mutants(corpus, mutants, count > 3 ? std::strtoull(words[3], nullptr, 10) : 1);
  std::cout << corpus.size() << " inputs, " << mutants << " mutants\n";
  return 0;
}
