// SPDX-License-Identifier: MIT
// A table of numbers in a text file: CSV or separated by blanks, plain or compressed (.gz).
//
// Units       those of the file; what a column means is the caller's to say.
// Domain      one row per line; fields are separated by semicolons or else commas, or by blanks
//             where the first row has neither. An empty field behind the last separator of a line
//             is no column, but is read as an empty field if a column is asked for there. After #
//             is a comment, blank lines are skipped. The first line without numbers names the
//             columns; without one, a comment right above the first row does, if it has as many
//             words ("# t x y z"); comments above the rows are kept for who understands them. Of
//             what JPL's Horizons sends (CSV_FORMAT = YES) the rows between $$SOE and $$EOE, with
//             the names above. Numbers as in C or Fortran (1.5e3, 1.5D+03). Lines of at most
//             1 MiB.
// Accuracy    the nearest double.
// Errors      DomainError "FILE:LINE: ..." for the first thing wrong: a missing column or field,
//             text that is no finite number, a damaged .gz; "FILE: ..." for what cannot be read.
// Cost        some 60 ns per field that is asked for, of a .gz 150 ns
//             (benchmarks/number_table.cpp); the columns asked for are held.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/version.hpp"  // asks for C++20

namespace polhode {
inline namespace v0 {
namespace io {

struct NumberTable {
  // What stands above the first row: a comment without its #, or a line of the banner of Horizons.
  struct Comment {
    std::string text;
    std::uint32_t line = 0;
    bool is_banner = false;
  };

  std::string file;                          // as messages show it
  std::vector<std::vector<double>> columns;  // in the order in which they were asked for
  std::vector<std::uint32_t> lines;          // of the file, from 1: where each row stands
  std::vector<std::string> names;            // of all columns of the file; may be none
  std::vector<Comment> comments;             // the first 10000 of them

  std::size_t rows() const { return lines.size(); }
};

// A field as a number. Throws DomainError with the reason alone: "is not a number".
using FieldReader = std::function<double(std::string_view)>;
// The usual one: a finite number.
double number_from_field(std::string_view field);

// The names of the columns of a file, or where it has none, their numbers from 1 as text. Empty
// for a file without rows.
std::vector<std::string> table_columns(const std::string& path);

// `columns` names each by the header of the file or by its number from 1 ("3"). `first` reads the
// first of them: times may be dates.
NumberTable read_number_table(const std::string& path, std::span<const std::string> columns,
                              const FieldReader& first = number_from_field);
// The same with a reader for each column. Fields of the `unchecked` lines that cannot be read are
// NaN.
NumberTable read_number_table(const std::string& path, std::span<const std::string> columns,
                              std::span<const FieldReader> readers,
                              std::span<const std::size_t> unchecked = {});

// Throws unless a column rises from row to row: "FILE:LINE: time 5 comes twice; ...". `what` is
// what the column holds.
void require_rising(const NumberTable& table, std::size_t column, std::string_view what);

}  // namespace io
}  // namespace v0
}  // namespace polhode
