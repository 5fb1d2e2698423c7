/// replay CORPUS: gives every input of a corpus file to the target, in place of libFuzzer. A line is an input, with \xNN for
/// bytes that are no printable ASCII and for the backslash.
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iostream>
#include <string>

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

}  // namespace

int main(int count, char** words) {
  std::ifstream corpus(count == 2 ? words[1] : "");
  if (!corpus) {
    std::cerr << "replay: no corpus\n";
    return 2;
  }
  std::size_t inputs = 0;
  for (std::string line; std::getline(corpus, line); ++inputs) {
    const std::string bytes = unescaped(line);
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  }
  std::cout << inputs << " inputs\n";
  return inputs > 0 ? 0 : 1;
}
