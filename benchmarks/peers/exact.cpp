// SPDX-License-Identifier: MIT
// The textbook form at 50 digits.
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>

#include "boost_form.hpp"
#include "textbook.hpp"
#include "worst.hpp"

namespace peers {
namespace {

using Wide = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>,
                                           boost::multiprecision::et_off>;
using Form = Textbook<BoostFunctions<Wide, boost::math::policies::policy<>>>;

Four<Wide> conjugate(const Four<Wide>& q) { return {q[0], -q[1], -q[2], -q[3]}; }

// A row's attitude; a matrix becomes a quaternion by its largest column of q q^T.
Four<Wide> attitude(std::span<const double> row) {
  if (row.size() == 7) return {row[0], row[1], row[2], row[3]};
  const auto m = [&](std::size_t i, std::size_t j) { return Wide(row[3 * i + j]); };
  const std::array<Wide, 4> squares{
      1 + m(0, 0) + m(1, 1) + m(2, 2), 1 + m(0, 0) - m(1, 1) - m(2, 2),
      1 - m(0, 0) + m(1, 1) - m(2, 2), 1 - m(0, 0) - m(1, 1) + m(2, 2)};
  std::size_t most = 0;
  for (std::size_t k = 1; k < 4; ++k)
    if (squares[k] > squares[most]) most = k;
  const Wide a = m(2, 1) - m(1, 2), b = m(0, 2) - m(2, 0), c = m(1, 0) - m(0, 1);
  const Wide d = m(0, 1) + m(1, 0), e = m(0, 2) + m(2, 0), f = m(1, 2) + m(2, 1);
  const std::array<Four<Wide>, 4> columns{Four<Wide>{squares[0], a, b, c},
                                          {a, squares[1], d, e},
                                          {b, d, squares[2], f},
                                          {c, e, f, squares[3]}};
  return columns[most];
}

Four<Wide> unit(const Four<Wide>& q) {
  const Wide n = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  return {q[0] / n, q[1] / n, q[2] / n, q[3] / n};
}

}  // namespace

struct Exact::Parts {
  Form form;
  Four<Wide> start;
  explicit Parts(const Start& s) : form(s) { start = at(0.0); }
  Four<Wide> at(double t) const {
    std::array<Wide, 7> row;
    form.row(Wide(t), row);
    return {row[0], row[1], row[2], row[3]};
  }
};

Exact::Exact(const Start& start) : parts_(std::make_unique<Parts>(start)) {}
Exact::~Exact() = default;

double Exact::action() const {
  return static_cast<double>(Wide(parts_->form.sadov()[0] / parts_->form.momentum()));
}

double Exact::error(double t, std::span<const double> row, std::span<const double> row0) const {
  const Four<Wide> moved = product(conjugate(unit(attitude(row0))), unit(attitude(row)));
  const Four<Wide> exact = product(conjugate(parts_->start), parts_->at(t));
  const Four<Wide> rest = product(conjugate(exact), moved);
  polhode::test::Worst worst;
  for (std::size_t k = 1; k < 4; ++k) worst.add(std::abs(static_cast<double>(rest[k])));
  return worst.value();
}

}  // namespace peers
