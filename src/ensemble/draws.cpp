// SPDX-License-Identifier: MIT
#include "polhode/ensemble/draws.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
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

}  // namespace v0
}  // namespace polhode
