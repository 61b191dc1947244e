// SPDX-License-Identifier: MIT
// Draws of members: random numbers by counter, Sobol points, and what is drawn from them.
#include "polhode/ensemble/draws.hpp"

#include <Random123/philox.h>

#include <algorithm>
#include <array>
#include <boost/random/sobol.hpp>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "ensemble/detail/philox.hpp"
#include "math/number_text.hpp"
#include "polhode/ensemble/distributions.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace ensemble {

namespace detail {

PhiloxCounter philox(const PhiloxCounter& counter, const PhiloxKey& key) {
  const philox4x64_ctr_t block =
      philox4x64_R(10, {{counter[0], counter[1], counter[2], counter[3]}}, {{key[0], key[1]}});
  return {block.v[0], block.v[1], block.v[2], block.v[3]};
}

}  // namespace detail

std::uint64_t CounterRandom::bits(std::uint64_t member, std::uint64_t draw) const {
  return detail::philox({draw / 4, member, 0, 0}, {seed_, key_})[draw % 4];
}

double CounterRandom::normal(std::uint64_t member, std::uint64_t draw) const {
  return normal_quantile(uniform(member, draw));
}

void CounterRandom::uniforms(std::uint64_t member, std::span<double> u) const {
  for (std::size_t first = 0; first < u.size(); first += 4) {
    const detail::PhiloxCounter block = detail::philox({first / 4, member, 0, 0}, {seed_, key_});
    const std::size_t count = std::min<std::size_t>(4, u.size() - first);
    for (std::size_t i = 0; i < count; ++i) u[first + i] = open_uniform(block[i]);
  }
}

std::uint64_t CounterRandom::shared_bits(std::uint64_t draw) const {
  return detail::philox({draw / 4, 0, 0, 1}, {seed_, key_})[draw % 4];
}

namespace {

std::size_t checked(std::size_t dimensions) {
  if (dimensions < 1 || dimensions > SobolPoints::most_dimensions)
    throw DomainError("SobolPoints: " + std::to_string(dimensions) +
                      " dimensions must be from 1 to " +
                      std::to_string(SobolPoints::most_dimensions));
  return dimensions;
}

}  // namespace

const std::size_t SobolPoints::most_dimensions = boost::random::default_sobol_table::max_dimension;

// Boost's engine goes from point to point; its points at which the Gray code has one bit are the
// direction numbers. Its points begin with ours of index 1.
SobolPoints::SobolPoints(std::size_t dimensions) : directions_(64 * checked(dimensions)) {
  boost::random::sobol engine(dimensions);
  for (std::size_t bit = 0; bit < 64; ++bit) {
    const std::uint64_t index = ~std::uint64_t{0} >> (63 - bit);  // Gray code 2^bit
    engine.seed(index - 1);
    for (std::size_t i = 0; i < dimensions; ++i) directions_[64 * i + bit] = engine();
  }
}

namespace {

using polhode::detail::number_text;

constexpr double most_points = 0x1p53;

SaveAt points_of(const DrawAxis& axis, std::size_t index) {
  const std::string name = "DrawGrid: axis[" + std::to_string(index) + "]: ";
  for (const auto& [what, value] : {std::pair("from", axis.from), std::pair("to", axis.to)})
    if (!std::isfinite(value))
      throw DomainError(name + what + " " + number_text(value) + " must be finite");
  if (axis.count < 1)
    throw DomainError(name + "count " + std::to_string(axis.count) + " must be 1 or more");
  return SaveAt::count(axis.from, axis.count == 1 ? axis.from : axis.to, axis.count);
}

void require_inside(const char* function, std::uint64_t index, std::uint64_t size) {
  if (index >= size)
    throw DomainError(std::string(function) + ": index " + std::to_string(index) +
                      " must be below " + std::to_string(size));
}

}  // namespace

DrawGrid::DrawGrid(std::vector<DrawAxis> axes) : axes_(std::move(axes)) {
  if (axes_.empty()) throw DomainError("DrawGrid: 0 axes must be one or more");
  double points = 1.0;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    points *= static_cast<double>(axes_[i].count);
    if (points > most_points)
      throw DomainError("DrawGrid: axis[" + std::to_string(i) + "]: count " +
                        std::to_string(axes_[i].count) +
                        " makes more points than 2^53, which must be the most");
    points_.push_back(points_of(axes_[i], i));
    size_ *= static_cast<std::uint64_t>(axes_[i].count);
  }
}

void DrawGrid::at(std::uint64_t index, std::span<double> x) const {
  require_inside("DrawGrid::at", index, size_);
  for (std::size_t i = axes_.size(); i-- > 0;) {
    const auto count = static_cast<std::uint64_t>(axes_[i].count);
    x[i] = points_[i][static_cast<std::int64_t>(index % count)];
    index /= count;
  }
}

DrawTable::DrawTable(std::size_t columns, std::vector<double> numbers, RowOrder order)
    : columns_(columns), order_(order) {
  if (columns == 0) throw DomainError("DrawTable: 0 columns must be one or more");
  if (numbers.empty()) throw DomainError("DrawTable: 0 rows must be one or more");
  if (numbers.size() % columns != 0)
    throw DomainError("DrawTable: " + std::to_string(numbers.size()) +
                      " numbers must be whole rows of " + std::to_string(columns));
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (!std::isfinite(numbers[i]))
      throw DomainError("DrawTable: row " + std::to_string(i / columns) + ", column " +
                        std::to_string(i % columns) + ": " + number_text(numbers[i]) +
                        " must be finite");
  numbers_ = std::make_shared<const std::vector<double>>(std::move(numbers));
}

std::span<const double> DrawTable::row(std::uint64_t index) const {
  require_inside("DrawTable::row", index, rows());
  return std::span<const double>(*numbers_).subspan(index * columns_, columns_);
}

std::span<const double> DrawTable::from_uniform(double u) const {
  const auto row_of = static_cast<std::uint64_t>(u * static_cast<double>(rows()));
  return row(std::min(row_of, rows() - 1));  // the product may be rounded up
}

namespace {

// The numbers of a draw, the uniform numbers that it takes, and the draw: one of each distribution.
// Those of one number are the rest.
template <class OneNumber>
std::size_t numbers(const OneNumber&) {
  return 1;
}
std::size_t numbers(const JointNormal& of) { return of.size(); }
std::size_t numbers(const IsotropicDirection&) { return 3; }
std::size_t numbers(const UniformAttitude&) { return 4; }
std::size_t numbers(const DrawGrid& of) { return of.axes().size(); }
std::size_t numbers(const DrawTable& of) { return of.columns(); }

template <class OneNumber>
std::size_t taken(const OneNumber&) {
  return 1;
}
std::size_t taken(const JointNormal& of) { return of.size(); }
std::size_t taken(const IsotropicDirection&) { return 2; }
std::size_t taken(const UniformAttitude&) { return 3; }
std::size_t taken(const DrawGrid&) { return 0; }
std::size_t taken(const DrawTable& of) { return of.order() == RowOrder::in_order ? 0 : 1; }

using Member = std::uint64_t;
using In = std::span<const double>;
using Out = std::span<double>;

template <class OneNumber>
void drawn(const OneNumber& of, Member, In u, Out x) {
  x[0] = of.from_uniform(u[0]);
}
void drawn(const JointNormal& of, Member, In u, Out x) { of.from_uniform(u, x); }
void drawn(const IsotropicDirection& of, Member, In u, Out x) {
  const Vec3 v = of.from_uniform(u[0], u[1]);
  std::copy_n(std::array{v.x, v.y, v.z}.begin(), 3, x.begin());
}
void drawn(const UniformAttitude& of, Member, In u, Out x) {
  const Quaternion q = of.from_uniform(u[0], u[1], u[2]);
  std::copy_n(std::array{q.w, q.x, q.y, q.z}.begin(), 4, x.begin());
}
void drawn(const DrawGrid& of, Member member, In, Out x) { of.at(member % of.size(), x); }
void drawn(const DrawTable& of, Member member, In u, Out x) {
  const In row = of.order() == RowOrder::in_order ? of.row(member) : of.from_uniform(u[0]);
  std::copy(row.begin(), row.end(), x.begin());
}

void require_names(const std::vector<Varied>& varied) {
  for (auto one = varied.begin(); one != varied.end(); ++one) {
    if (one->name.empty()) throw DomainError("Draws: name \"\" must not be empty");
    for (auto other = varied.begin(); other != one; ++other)
      if (key_of(other->name) == key_of(one->name))
        throw DomainError("Draws: names \"" + other->name + "\" and \"" + one->name +
                          "\" must differ, and so must their keys");
  }
}

// Room for uniform numbers: on the stack, unless they are many.
class Room {
 public:
  explicit Room(std::size_t count) : count_(count), many_(count > few_.size() ? count : 0) {}
  Out numbers() { return many_.empty() ? Out(few_).first(count_) : Out(many_); }

 private:
  std::size_t count_;
  std::array<double, 8> few_;
  std::vector<double> many_;
};

}  // namespace

std::size_t numbers_of(const Distribution& distribution) {
  return std::visit([](const auto& of) { return numbers(of); }, distribution);
}

std::size_t uniforms_of(const Distribution& distribution) {
  return std::visit([](const auto& of) { return taken(of); }, distribution);
}

void draw(const Distribution& distribution, std::uint64_t member, std::span<const double> u,
          std::span<double> x) {
  std::visit([&](const auto& of) { drawn(of, member, u, x); }, distribution);
}

Draws::Draws(std::vector<Varied> varied, std::uint64_t seed, DrawSource source)
    : varied_(std::move(varied)) {
  require_names(varied_);
  std::size_t dimensions = 0;
  for (const auto& [name, distribution] : varied_) {
    Source of{CounterRandom(seed, key_of(name)), dimensions, {}};
    for (std::size_t i = 0; i < uniforms_of(distribution); ++i)
      of.shifts.push_back(of.random.shared_bits(i));
    dimensions += of.shifts.size();
    sources_.push_back(std::move(of));
    const DrawTable* const table = std::get_if<DrawTable>(&distribution);
    if (table != nullptr && table->order() == RowOrder::in_order)
      most_members_ = std::min(most_members_, table->rows());
  }
  if (source == DrawSource::sobol && dimensions > 0) points_.emplace(dimensions);
}

void Draws::uniforms(std::uint64_t member, std::size_t key, std::span<double> u) const {
  const Source& of = sources_[key];
  if (!points_) return of.random.uniforms(member, u);
  for (std::size_t i = 0; i < u.size(); ++i)
    u[i] = open_uniform(points_->bits(member, of.dimension + i) ^ of.shifts[i]);
}

void Draws::values(std::uint64_t member, std::size_t key, std::span<double> x) const {
  if (const std::size_t size = numbers_of(varied_[key].distribution); x.size() != size)
    throw DomainError("Draws: room for " + std::to_string(x.size()) + " numbers of \"" +
                      varied_[key].name + "\" must be for " + std::to_string(size));
  Room room(sources_[key].shifts.size());
  uniforms(member, key, room.numbers());
  draw(varied_[key].distribution, member, room.numbers(), x);
}

std::vector<double> Draws::values(std::uint64_t member, std::size_t key) const {
  std::vector<double> x(numbers_of(varied_[key].distribution));
  values(member, key, x);
  return x;
}

double Draws::value(std::uint64_t member, std::size_t key) const {
  double x = 0.0;
  values(member, key, {&x, 1});
  return x;
}

}  // namespace ensemble
}  // namespace v0
}  // namespace polhode
