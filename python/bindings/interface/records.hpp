// SPDX-License-Identifier: MIT
// Records<Row>: rows of a result, one after the other as C++ returned them. Columns are read-only
// views of the rows, which they keep alive, and nothing else.
#pragma once

#include <cstring>
#include <initializer_list>
#include <memory>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "interface/batch.hpp"
#include "motion/samples.hpp"

namespace polhode::python {

template <class Row>
class Records {
  static_assert(std::is_trivially_copyable_v<Row>);

 public:
  explicit Records(std::vector<Row> rows)
      : rows_(std::make_shared<const std::vector<Row>>(std::move(rows))) {}
  // What bytes() gave.
  explicit Records(const nb::bytes& bytes) {
    if (bytes.size() % sizeof(Row) != 0)
      throw nb::value_error("this pickle is of another version or machine");
    std::vector<Row> rows(bytes.size() / sizeof(Row));
    if (!rows.empty()) std::memcpy(rows.data(), bytes.data(), bytes.size());
    rows_ = std::make_shared<const std::vector<Row>>(std::move(rows));
  }

  const std::vector<Row>& rows() const { return *rows_; }
  nb::bytes bytes() const { return nb::bytes(rows_->data(), rows_->size() * sizeof(Row)); }

  // (N,) + inner: the numbers of every row that begin at first(row).
  FloatArray column(const double* (*first)(const Row&), const Shape& inner = {}) const {
    return view_of(rows_->empty() ? nullptr : first(rows_->front()), rows_->size(), sizeof(Row),
                   inner, keeper(rows_));
  }
  // (N,): the states of every row.
  template <class S>
  Batch<S> states(const S& (*of)(const Row&)) const {
    if (rows_->empty()) return Batch<S>::filled({0}, [](S*) {});
    return Batch<S>({rows_->size()}, rows_, &of(rows_->front()), sizeof(Row));
  }

 private:
  std::shared_ptr<const std::vector<Row>> rows_;
};

template <class Row>
struct RecordColumn {
  const char* name;
  const double* (*first)(const Row&);
  const char* text;
  Shape inner = {};
};

// Of a class C that is a Records<Row>: columns, length, and copies, which are the same object.
template <class Row, class C>
void def_records(nb::class_<C>& c, std::initializer_list<RecordColumn<Row>> columns) {
  for (const RecordColumn<Row>& column : columns)
    c.def_prop_ro(
        column.name,
        [first = column.first, inner = column.inner](const C& r) { return r.column(first, inner); },
        column.text);
  c.def("__len__", [](const C& r) { return r.rows().size(); })
      .def("__copy__", [](nb::handle_t<C> self) { return self; })
      .def(
          "__deepcopy__", [](nb::handle_t<C> self, nb::handle) { return self; }, "memo"_a);
}

// Pickles of rows and `members`, of which C is made in this order.
template <class C, class... M>
void def_pickle(nb::class_<C>& c, M C::*... members) {
  c.def("__getstate__", [=](const C& r) {
     return nb::make_tuple(r.bytes(), (r.*members)...);
   }).def("__setstate__", [](C& r, const std::tuple<nb::bytes, M...>& state) {
    std::apply(
        [&](const nb::bytes& rows, const M&... rest) {
          new (&r) C{typename C::Rows(rows), rest...};
        },
        state);
  });
}

}  // namespace polhode::python
