// SPDX-License-Identifier: MIT
#include "polhode/tables/convert.hpp"

#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "polhode/error.hpp"
#include "polhode/output/sink.hpp"
#include "polhode/tables/aem.hpp"

namespace polhode::cli {
namespace {

struct ConvertOptions {
  std::string from;
  std::string to;
  std::string moments;
  std::string in = "-";
};

// Standard input, or a pipe: rows come out before it ends.
class InputFile {
 public:
  explicit InputFile(const std::string& path)
      : name_(path == "-" ? "<stdin>" : path), file_(stdin) {
    if (path == "-") return;
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored))
      throw DomainError(name_ + ": is a folder; expected a CSV file");
    file_ = std::fopen(path.c_str(), "rb");
    if (file_ == nullptr) fail();
  }
  ~InputFile() {
    if (file_ != stdin) std::fclose(file_);
  }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::string& name() const { return name_; }
  // Past the buffer of FILE, which would wait for all of a large read.
  std::size_t read(std::span<char> buffer) {
    for (;;) {
      const ssize_t count = ::read(::fileno(file_), buffer.data(), buffer.size());
      if (count >= 0) {
        const auto size = static_cast<std::size_t>(count);
        const std::string_view bytes(buffer.data(), size);
        if (std::exchange(is_first_, false) && bytes.starts_with("\x1f\x8b"))
          throw DomainError(name_ + ": is packed by gzip; expected text, or a .gz file as FILE");
        return size;
      }
      if (errno != EINTR) fail();
    }
  }

 private:
  [[noreturn]] void fail() const {
    throw DomainError(name_ + ": cannot be read: " + std::strerror(errno));
  }
  std::string name_;
  std::FILE* file_;
  bool is_first_ = true;  // what is read next
};

Body body_of(const std::string& moments) {
  const std::string got = "convert: --moments: got \"" + moments + "\"; ";
  double I[3] = {};
  const char* p = moments.data();
  const char* end = p + moments.size();
  for (int i = 0; i < 3; ++i) {
    const auto [stop, error] = std::from_chars(p, end, I[i]);
    const bool last = i == 2;
    if (error != std::errc() || (last ? stop != end : stop == end || *stop != ','))
      throw DomainError(got + "expected three numbers I1,I2,I3");
    p = last ? stop : stop + 1;
  }
  try {
    return Body(I[0], I[1], I[2]);
  } catch (const DomainError& error) {
    throw DomainError(got + error.what());
  }
}

// The table of an attitude file is not one of a chart: q alone, or q and the angular velocity.
void convert_aem(const ConvertOptions& options) {
  if (options.to != "csv")
    throw DomainError("convert: --to: got \"" + options.to + "\"; expected csv, of --from aem");
  print(io::aem_csv(io::read_aem(options.in)));
}

void convert_file(const ConvertOptions& options, std::span<const io::ChartKind> charts) {
  if (options.from == "aem") return convert_aem(options);
  io::Conversion conversion{options.from, options.to, std::nullopt};
  if (!options.moments.empty()) conversion.body = body_of(options.moments);
  const auto write = [](std::string_view bytes) { print(bytes); };
  std::error_code ignored;
  if (std::filesystem::is_regular_file(options.in, ignored) && options.in != "-")
    return io::convert(conversion, options.in, io::file_source(options.in), write, charts);
  InputFile in(options.in);
  io::convert(
      conversion, in.name(), [&](std::span<char> buffer) { return in.read(buffer); }, write,
      charts);
}

// "serret: g0,h,t0,G,H,T (sign_g1,sign_g3); --moments"
std::string chart_line(const io::ChartKind& chart) {
  std::string numbers, branch;
  for (const io::ChartVariable& variable : chart.variables)
    numbers += (numbers.empty() ? "" : ",") + std::string(variable.name);
  for (const std::string_view name : io::branch_columns(chart))
    branch += (branch.empty() ? "" : ",") + std::string(name);
  return std::string(chart.name) + ": " + numbers + (branch.empty() ? "" : " (" + branch + ")") +
         (chart.needs_body ? "; --moments" : "");
}

}  // namespace

void add_convert(CLI::App& app, const io::Kinds& kinds) {
  CLI::App* command = app.add_subcommand(
      "convert", "Convert a CSV table of states to another chart, row by row (angles in radians)");
  const auto options = std::make_shared<ConvertOptions>();
  std::string charts = "Charts and the columns they need:\n";
  std::vector<std::string> from, to;
  for (const io::ChartKind& chart : kinds.charts()) {
    charts += "  " + chart_line(chart) + "\n";
    from.emplace_back(chart.name);
  }
  to = from;
  from.emplace_back("aem");
  to.emplace_back("csv");
  charts += "\nA CCSDS Attitude Ephemeris Message becomes a table by --from aem --to csv.\n";
  offer(*command->add_option("--from", options->from, "Chart of the input, or aem")->required(),
        from);
  offer(*command->add_option("--to", options->to, "Chart of the output; csv of aem")->required(),
        to);
  command->add_option("--moments", options->moments, "Principal moments, for charts that need them")
      ->type_name("I1,I2,I3");
  command->add_option("FILE", options->in, "CSV to read, .gz or not; - is standard input")
      ->capture_default_str();
  command->footer(charts + "\nExample:\n  " + full_name(*command) +
                  " --from rotor --to andoyer < in.csv > out.csv");
  command->callback([options, kinds] { convert_file(*options, kinds.charts()); });
}

}  // namespace polhode::cli
