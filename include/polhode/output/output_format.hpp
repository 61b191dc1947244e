// SPDX-License-Identifier: MIT
// OutputFormat: all about one format of output files: its name and extension, how rows are written,
// what it needs of a run, its keys in [output.NAME] and what it cites. open_sink, the reader of
// scenarios, `polhode run` and Python ask a list of them; a program of your own adds its own:
//
//     const OutputFormats formats = default_output_formats().with(my_format());
//
// Units       those that the columns name; options are in core units (polhode/text/units.hpp).
// Domain      open_sink: "-" (standard output, in the first format that needs no file), or a path
//             with the extension of a format. With a position, it cuts PATH.part back to it and
//             goes on from there. A text format is most easily written by text_sink
//             (polhode/output/output_format.hpp).
// Accuracy    CSV numbers are the shortest that read back to the same double; HDF5 holds doubles.
// Errors      a key without a name, a dimension or a text does not compile. open_sink: DomainError
//             for a path that cannot be an output, for a run that lacks what the format needs, and
//             for a PATH.part that is not what a position belongs to. with: DomainError for a name
//             or an extension that is taken.
// Cost        CSV about 60 ns per number.
#pragma once

#include <any>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "polhode/error.hpp"
#include "polhode/output/column_kind.hpp"
#include "polhode/output/sink.hpp"
#include "polhode/text/citation.hpp"
#include "polhode/text/kind_key.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

// What a sink is opened for. It refers to what the caller has.
struct SinkRequest {
  const std::string& path;  // a file or a device, or "-"
  const std::vector<ColumnGroup>& groups;
  const Provenance& provenance;
  const std::optional<SinkPosition>& from;  // where a file that is there goes on
  const std::any& asked;                    // what `options` of the format has made, or nothing

  // What the scenario asks of the format; its defaults where it asks nothing.
  template <class Options>
  Options options() const {
    const Options* const made = std::any_cast<Options>(&asked);
    return made == nullptr ? Options{} : *made;
  }
};

// What a run must have. Other runs are refused before a file is there.
struct FormatNeeds {
  bool file = false;    // neither standard output nor a device
  bool dates = false;   // an epoch, in a scale that runs evenly
  bool rising = false;  // each row later than the one before
};

// What a number of a row takes in a file; 0: it is not known.
struct NumberBytes {
  int least = 0;
  int usual = 0;
};

struct OutputFormat {
  using Open = std::function<std::unique_ptr<Sink>(const SinkRequest&)>;

  OutputFormat(std::string its_name, std::string its_extension, std::string its_help, Open its_open)
      : name(std::move(its_name)),
        label(name),
        extension(std::move(its_extension)),
        help(std::move(its_help)),
        open(std::move(its_open)) {}

  std::string name;       // "aem", of letters, digits, - and _
  std::string label;      // as messages say it: "an AEM"; the name where nothing else is said
  std::string extension;  // ".aem"
  std::string help;       // what it is, or what [output.NAME] says; one or two sentences
  Open open;
  FormatNeeds needs = {};
  NumberBytes number_bytes = {};
  // The groups of columns that it needs, which may depend on the run and the options.
  std::function<std::vector<std::string>(const SinkRequest&)> columns = {};

  // [output.NAME]: its keys, and the format's own struct made from their values. A DomainError
  // becomes an error at the place of the table.
  std::vector<Key> keys = {};
  std::function<std::any(const KeyValues&)> options = {};
  // Both, for a plain struct that the keys fill; `check` refuses what the types let pass.
  template <class A>
  void take_options(std::span<const KindKey<A>> of,
                    void (*check)(const A&, const KeyValues&) = nullptr) {
    keys = keys_of(of);
    options = [all = std::vector<KindKey<A>>(of.begin(), of.end()), check](const KeyValues& at) {
      A made = arguments<A>(all, at);
      if (check != nullptr) check(made, at);
      return std::any(std::move(made));
    };
  }

  // Why a complete file is not what this run would write: "of another scenario". Empty: it is.
  // None: nobody can tell, and a complete file is not taken for one of this run.
  std::function<std::string(const std::string& path, const std::vector<ColumnGroup>&,
                            const Provenance&)>
      difference = {};
  // The first `count` rows of a file of these columns, complete or not. None: they are not read
  // back.
  std::function<std::vector<double>(const std::string& path, const std::vector<ColumnGroup>&,
                                    std::int64_t count)>
      rows = {};

  std::vector<Citation> citations = {};  // where a scenario has the table [output.NAME]
};

// The formats that there are, in the order in which messages name them. Copies share.
class OutputFormats {
 public:
  explicit OutputFormats(std::vector<OutputFormat> all);
  OutputFormats with(OutputFormat format) const;

  std::span<const OutputFormat> all() const { return *all_; }
  // Null where there is none.
  const OutputFormat* named(std::string_view name) const;
  const OutputFormat* of_extension(std::string_view path) const;
  // That of "-" and of devices; null where every format needs a file.
  const OutputFormat* of_streams() const;
  // Which one open_sink takes. DomainError where there is none, and for a folder.
  const OutputFormat& of_output(const std::string& path) const;

 private:
  std::shared_ptr<const std::vector<OutputFormat>> all_;
};

// CSV, HDF5 and CCSDS Attitude Ephemeris Messages.
OutputFormats default_output_formats();

// "PATH.csv, PATH.h5 or PATH.aem": those of which the condition holds.
std::string paths_in_words(const OutputFormats& formats,
                           const std::function<bool(const OutputFormat&)>& of = {});

// Whether one of these outputs can be read back, and the first rows of the first of them that can:
// of PATH, or of PATH.part where there is no PATH. No sink may have the file open.
bool can_read_rows(const OutputFormats& formats, std::span<const std::string> paths);
std::vector<double> first_rows(const OutputFormats& formats, std::span<const std::string> paths,
                               const std::vector<ColumnGroup>& groups, std::int64_t count);

std::unique_ptr<Sink> open_sink(const std::string& path, const std::vector<ColumnGroup>& groups,
                                const Provenance& provenance,
                                const std::optional<SinkPosition>& from = std::nullopt,
                                const OutputFormats& formats = default_output_formats());

// OutputPlan: what the rows of a scenario hold and how they are written.
//
// Domain      groups of columns by their names (polhode/output/column_kind.hpp).
// Errors      none; a group that the experiment does not have is refused when the file is read.

struct OutputPlan {
  std::vector<std::string> columns;  // names of column groups
  OutputFormats formats = default_output_formats();
  FormatOptions options = {};  // of the formats whose tables [output.NAME] the file has
};

// text_sink: most of an output format of text: a head that says where the file is from, a line for
// each row, and perhaps an end.
//
// Units       those that the columns name.
// Domain      a file that goes on is cut back to its position; its head must be the same. The
//             comments of a head begin with the start of their style.
// Accuracy    what `row` appends.
// Errors      DomainError as open_sink; OutputError when writing fails.
// Cost        a call of `row` per row, a system call per block.

// How a format writes comments.
struct CommentStyle {
  std::string_view start;
  std::size_t longest = std::string_view::npos;  // text in one line
  bool ascii = false;                            // what is beyond it becomes ?
  // What the first line behind the head begins with. Empty: that is the first line that is no
  // comment, and it names the columns.
  std::string_view head_end = {};
};

// One line or more for each line of the text, with `lead` in front.
void append_comment(std::string& out, const CommentStyle& style, std::string_view lead,
                    std::string_view text);
// Version, title, notes, citations and scenario.
void append_origin(std::string& out, const CommentStyle& style, const Provenance& provenance);

// Why a complete file is not one with this head: "of another scenario". Empty: it is.
std::string text_difference(const std::string& path, const CommentStyle& style,
                            const std::string& head);

// `closing`: how comments look behind the rows, where a format may have them there.
std::unique_ptr<Sink> text_sink(
    const SinkRequest& request, const std::string& head,
    std::function<void(std::string& out, std::span<const double> row)> row, std::string end = {},
    const CommentStyle& closing = {});

}  // namespace io
}  // namespace v0
}  // namespace polhode
