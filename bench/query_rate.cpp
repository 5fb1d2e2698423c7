/// query_rate [SETTINGS [FOLDER]]
///
/// How long a query takes: over a portrait of about SETTINGS settings (10^7) with ten measures, under four constraints
/// that admit about 1 % of them. Once as it is; once with what is known of tiles withheld, which makes it a plain scan of
/// the same columns by the same code and threads; and once in numpy on the same file, when Debian's Python is there. The
/// answers are compared first. Medians of interleaved repetitions; cold: the file's pages are dropped before each.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "portraits/query/query.h"
#include "portraits/reader.h"
#include "portraits/writer.h"

namespace portrait {
namespace {

using Clock = std::chrono::steady_clock;

/// Nothing is known of its tiles.
class Unsummarised final : public ColumnSource {
 public:
  explicit Unsummarised(const ColumnSource& source) : source_(source) {}
  explicit Unsummarised(std::unique_ptr<ColumnSource> own) : own_(std::move(own)), source_(*own_) {}

  const Grid& grid() const override { return source_.grid(); }
  void read(Measure measure, std::uint64_t first, std::size_t count, std::vector<double>& values) const override {
    source_.read(measure, first, count, values);
  }
  void read_statuses(std::uint64_t first, std::size_t count, std::vector<Status>& statuses) const override {
    source_.read_statuses(first, count, statuses);
  }
  std::unique_ptr<ColumnSource> for_another_thread() const override {
    return std::make_unique<Unsummarised>(source_.for_another_thread());
  }

 private:
  std::unique_ptr<ColumnSource> own_;
  const ColumnSource& source_;
};

Grid grid_of(std::uint64_t settings) {
  const auto each = static_cast<std::uint64_t>(std::lround(std::cbrt(static_cast<double>(settings) / 80)));
  return {
      .title = "query_rate",
      .family = {.plant = Plant::dipdt, .n = 1, .prefilter = Prefilter::full},
      .horizon = Horizon::fixed(51),
      .sampling = std::nullopt,
      .precision = Precision::real64,
      .measures = {Measure::IAE_w, Measure::IAE_d, Measure::ITAE_d, Measure::TV0_yw, Measure::TV2_uw,
                   Measure::TV1_yd, Measure::TV2_ud, Measure::u_max_w, Measure::Ms, Measure::Mt},
      .axes = {Axis::linear(Parameter::kappa, 0.05, 0.35, each), Axis::linear(Parameter::delta, 0.35, 1.05, each),
               Axis::linear(Parameter::tau_i, 6, 22, each), Axis::logarithmic(Parameter::tau_f, 0.01, 1, 80)},
      .fixed = {{Parameter::b, 0}, {Parameter::c, 0}},
      .text = "# made by query_rate\n"};
}

/// Smooth over the grid as real measures are, with a limit of stability and shapes that are perfect in a part of it.
double value(Measure measure, const Setting& s) {
  const double damping = s.delta / std::sqrt(s.kappa), strain = s.kappa * 2.2 + 0.75 * s.delta + 0.5 * s.tau_f;
  switch (measure) {
    case Measure::IAE_w:
      return s.tau_i + 2 * s.tau_f + 0.3 / damping;
    case Measure::IAE_d:
      return s.tau_i / s.kappa * (1 + 0.1 * std::sin(3 * damping));
    case Measure::ITAE_d:
      return s.tau_i * s.tau_i / s.kappa * (1 + s.tau_f);
    case Measure::TV2_uw:
      return std::max(0.0, strain - 1 + 0.2 / s.tau_i);
    case Measure::TV0_yw:
      return std::max(0.0, 1.3 - damping + 1 / s.tau_i);
    case Measure::TV1_yd:
      return std::max(0.0, 1.1 - damping + 2 / s.tau_i) * 3;
    case Measure::TV2_ud:
      return std::max(0.0, strain - 0.95) * 1.5;
    case Measure::u_max_w:
      return s.kappa + s.delta * s.kappa / s.tau_i;
    case Measure::Ms:
      return 1 + 1.2 * strain * strain / (1.6 - std::min(strain, 1.5));
    default:
      return 1 + strain / damping;
  }
}

void write(const std::filesystem::path& path, const Grid& grid) {
  PortraitWriter writer(path, grid, {"query_rate", "none"}, Existing::replace);
  const TileRows rows(grid);
  for (std::uint64_t tile = 0; tile < rows.tile_count(); ++tile) {
    const std::vector<Setting> settings = settings_in(grid, rows.box(tile));
    MeasureColumns columns(grid.measures, settings.size());
    for (std::size_t i = 0; i < settings.size(); ++i) {
      const Setting& s = settings[i];
      const bool stable = s.kappa * 2.2 + 0.75 * s.delta + 0.5 * s.tau_f < 1.55;
      MeasureRow row;
      if (stable)
        for (const Measure measure : grid.measures) row[measure] = value(measure, s);
      columns.set(i, stable ? Status::settled : Status::unstable, row);
    }
    writer.write(writer.encode(tile, columns));
  }
  writer.publish({});
}

constexpr std::array<const char*, 4> kWhere = {"TV2_uw <= 0.02", "TV0_yw <= 0.01", "Ms <= 1.287", "u_max_w <= 0.2"};
constexpr const char* kMinimize = "IAE_w + IAE_d";

Question question() {
  Question asked{.minimize = parse_expression({"--minimize", kMinimize}), .conditions = {}};
  for (const char* text : kWhere) asked.conditions.where.push_back(parse_constraint({"--where", text}));
  return asked;
}

double seconds_of(const std::function<void()>& work) {
  const auto begin = Clock::now();
  work();
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

void drop_pages(const std::filesystem::path& path) {
  const int file = open(path.c_str(), O_RDONLY);
  if (file < 0 || fsync(file) != 0 || posix_fadvise(file, 0, 0, POSIX_FADV_DONTNEED) != 0)
    throw std::runtime_error("the file's pages cannot be dropped");
  close(file);
}

/// The most memory since the last call, in MB.
double peak_memory() {
  std::ifstream status("/proc/self/status");
  double peak = 0;
  for (std::string line; std::getline(status, line);)
    if (line.rfind("VmHWM:", 0) == 0) peak = std::strtod(line.c_str() + 6, nullptr) / 1024;
  std::ofstream("/proc/self/clear_refs") << 5;
  return peak;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// The output of Python running a script on one file, without a shell between; its end is ended().
class PythonRun {
 public:
  PythonRun(const std::string& script, const std::string& file) {
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe to Python");
    child_ = fork();
    if (child_ == 0) {
      dup2(ends[1], STDOUT_FILENO);
      execl("/usr/bin/python3", "python3", script.c_str(), file.c_str(), static_cast<char*>(nullptr));
      _exit(127);
    }
    close(ends[1]);
    output_ = fdopen(ends[0], "r");
  }
  ~PythonRun() { std::fclose(output_); }
  PythonRun(const PythonRun&) = delete;
  PythonRun& operator=(const PythonRun&) = delete;

  std::FILE* output() const { return output_; }
  bool ended_well() const {
    int status = 0;
    return waitpid(child_, &status, 0) == child_ && status == 0;
  }

 private:
  pid_t child_ = -1;
  std::FILE* output_ = nullptr;
};

/// Seconds that numpy takes, as the script says; nothing without Debian's Python.
std::optional<double> numpy_seconds(const std::filesystem::path& path, const Answer& answer) {
  const PythonRun python(fmt::format("{}/bench/query_rate_numpy.py", PORTRAIT_SOURCE_DIR), path.string());
  double seconds = 0, objective = 0;
  unsigned long long admissible = 0;
  const int read = std::fscanf(python.output(), "%lf %llu %lf", &seconds, &admissible, &objective);
  if (!python.ended_well() || read != 3) return std::nullopt;
  if (admissible != answer.admissible || objective != answer.top.at(0).objective)
    throw std::runtime_error("numpy gives another answer");
  return seconds;
}

struct Times {
  std::vector<double> skipping, scanning;
};

void run(std::uint64_t settings, const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "query_rate.h5";
  write(path, grid_of(settings));
  const Question asked = question();
  const auto skip = [&] { return ask(PortraitReader(path), asked); };
  const auto scan = [&] {
    const PortraitReader portrait(path);
    return ask(Unsummarised(portrait), asked);
  };
  peak_memory();
  const Answer answer = skip();
  const double memory = peak_memory();
  const Answer scanned = scan();
  if (answer.top.at(0).number != scanned.top.at(0).number || answer.admissible != scanned.admissible ||
      answer.active.size() != scanned.active.size())
    throw std::runtime_error("skipping gives another answer than scanning");
  Times warm, cold;
  for (int i = 0; i < 5; ++i) {
    warm.skipping.push_back(seconds_of(skip));
    warm.scanning.push_back(seconds_of(scan));
    drop_pages(path);
    cold.skipping.push_back(seconds_of(skip));
    drop_pages(path);
    cold.scanning.push_back(seconds_of(scan));
  }
  fmt::print("{} settings, 10 measures, {:.0f} MB, {} threads; minimize {} under {}\n", answer.total,
             static_cast<double>(std::filesystem::file_size(path)) * 1e-6, std::thread::hardware_concurrency(),
             kMinimize, fmt::join(kWhere, ", "));
  fmt::print("{} admissible ({:.2f} %), {} active constraints\n\n", answer.admissible,
             100 * static_cast<double>(answer.admissible) / static_cast<double>(answer.total),
             answer.active.size());
  fmt::print("{:<8}{:>12}{:>14}{:>10}\n", "pages", "query", "plain scan", "ratio");
  for (const auto& [name, times] : {std::pair{"warm", warm}, {"cold", cold}})
    fmt::print("{:<8}{:>10.3f} s{:>12.3f} s{:>10.1f}\n", name, median(times.skipping), median(times.scanning),
               median(times.scanning) / median(times.skipping));
  if (const auto numpy = numpy_seconds(path, answer))
    fmt::print("numpy, warm{:>9.3f} s, ratio {:.1f}\n", *numpy, *numpy / median(warm.skipping));
  fmt::print("memory of the query at most {:.0f} MB\n", memory);
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace portrait

int main(int count, char** words) try {
  const std::uint64_t settings = count > 1 ? std::strtoull(words[1], nullptr, 10) : 10'000'000;
  portrait::run(settings, count > 2 ? words[2] : ".");
} catch (const std::exception& error) {
  fmt::print(stderr, "query_rate: {}\n", error.what());
  return 1;
}
