// SPDX-License-Identifier: MIT
// Leading frequencies. Oracle: sums of lines that are known, with noise and without.
#include "polhode/analysis/spectrum.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::message_of;
using polhode::test::Worst;
using std::numbers::pi;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using Complex = std::complex<double>;

constexpr int count = 8001;
constexpr double start = -3000.0;
constexpr double apart = 2.0 * pi * 10.0 / (count - 1);  // 10 turns over the samples

struct Known {
  double frequency, amplitude, phase;
};

// Lines from 10 to 30 turns over the samples apart, amplitudes down to 1e-4 of the largest.
std::vector<Known> lines(int number, double first, unsigned seed) {
  std::mt19937_64 draw(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<Known> all;
  double frequency = first;
  for (int k = 0; k < number; ++k) {
    frequency += apart * (1.001 + 2.0 * uniform(draw));
    all.push_back({frequency, std::pow(10.0, -4.0 * uniform(draw)), 6.0 * uniform(draw) - 3.0});
  }
  all[0].amplitude = 1.0;
  return all;
}

std::vector<Complex> sum_of(const std::vector<Known>& all) {
  std::vector<Complex> x(count);
  for (int k = 0; k < count; ++k)
    for (const Known& one : all)
      x[static_cast<std::size_t>(k)] +=
          std::polar(one.amplitude, one.frequency * (start + k) + one.phase);
  return x;
}
std::vector<double> real_parts(const std::vector<Complex>& x, double mean) {
  std::vector<double> re;
  for (const Complex& one : x) re.push_back(mean + one.real());
  return re;
}

void expect_found(const analysis::Spectrum& found, const std::vector<Known>& all) {
  ASSERT_THAT(found.lines, SizeIs(all.size()));
  Worst frequency, amplitude, phase;
  for (const Known& one : all) {
    const analysis::SpectralLine* best = &found.lines[0];
    for (const analysis::SpectralLine& line : found.lines)
      if (std::fabs(line.frequency - one.frequency) < std::fabs(best->frequency - one.frequency))
        best = &line;
    frequency.add(std::fabs(best->frequency - one.frequency));
    amplitude.add(std::fabs(best->amplitude / one.amplitude - 1.0));
    phase.add(std::fabs(std::remainder(best->phase - one.phase, 2.0 * pi)));
  }
  EXPECT_LT(frequency.value(), budget::spectrum_frequency);
  EXPECT_LT(amplitude.value(), budget::spectrum_amplitude);
  EXPECT_LT(phase.value(), budget::spectrum_phase);
}

TEST(Spectrum, FindsTheLinesOfASum) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const std::vector<Known> all = lines(12, -0.1, seed);
    const analysis::Spectrum found = analysis::spectrum(start, 1.0, sum_of(all));
    expect_found(found, all);
    EXPECT_EQ(analysis::unresolved(found), 0);
    const std::vector<Known> positive = lines(12, 0.0, seed);
    const analysis::Spectrum of_real =
        analysis::spectrum(start, 1.0, std::span<const double>(real_parts(sum_of(positive), 3.25)));
    expect_found(of_real, positive);
    EXPECT_NEAR(of_real.mean, 3.25, budget::spectrum_amplitude);
  }
}

TEST(Spectrum, EveryWindowFindsThem) {
  const std::vector<Known> all = lines(6, -0.05, 5);
  for (const int window : {0, 1, 2, 3, 5})
    expect_found(analysis::spectrum(start, 1.0, sum_of(all), {.lines = 6, .window = window}), all);
}

// Squares of the samples have no room in double.
TEST(Spectrum, FindsLinesOfAnySize) {
  const std::vector<Known> all = lines(4, 0.0, 6);
  const double mean_size = analysis::spectrum(start, 1.0, sum_of(all), {.lines = 4}).size;
  for (const double size : {1e-300, 1e300}) {
    std::vector<Complex> x = sum_of(all);
    for (Complex& one : x) one *= size;
    analysis::Spectrum found = analysis::spectrum(start, 1.0, x, {.lines = 4});
    EXPECT_LT(found.residual, budget::spectrum_amplitude * size);
    EXPECT_NEAR(found.size / size, mean_size, budget::spectrum_amplitude);
    for (analysis::SpectralLine& line : found.lines) line.amplitude /= size;
    expect_found(found, all);
  }
}

// Errors are those that are told, as often as not.
TEST(Spectrum, TellsWhatNoiseDoes) {
  const std::vector<Known> all = lines(3, 0.1, 7);
  std::vector<double> x = real_parts(sum_of(all), 0.0);
  std::mt19937_64 draw(9);
  std::normal_distribution<double> noise(0.0, 0.01);
  for (double& one : x) one += noise(draw);
  const analysis::Spectrum found =
      analysis::spectrum(start, 1.0, std::span<const double>(x), {.lines = 1});
  const analysis::SpectralLine& line = found.lines[0];
  EXPECT_LT(std::fabs(line.frequency - all[0].frequency),
            budget::spectrum_noise * line.frequency_error);
  EXPECT_LT(std::fabs(line.amplitude - 1.0), budget::spectrum_noise * line.amplitude_error);
  EXPECT_GT(line.frequency_error, 0.0);
  EXPECT_LT(line.frequency_error, 1e-4 * apart * count / 10.0);
}

TEST(Spectrum, CountsLinesThatAreClose) {
  const std::vector<Known> close = {{0.3, 1.0, 0.0}, {0.3 + 0.4 * apart, 0.5, 1.0}};
  const analysis::Spectrum found = analysis::spectrum(start, 1.0, sum_of(close), {.lines = 2});
  EXPECT_EQ(analysis::unresolved(found), 2);
  EXPECT_NEAR(found.lines[0].isolation, 0.4 * apart, budget::spectrum_frequency);
  EXPECT_NEAR(found.resolution, apart, budget::spectrum_frequency);
  const std::vector<Known> slow = {{0.3 * apart, 1.0, 0.0}};
  const std::vector<double> x = real_parts(sum_of(slow), 0.0);
  const analysis::Spectrum of_slow =
      analysis::spectrum(start, 1.0, std::span<const double>(x), {.lines = 1});
  EXPECT_EQ(of_slow.lines[0].isolation, 2.0 * of_slow.lines[0].frequency);
  EXPECT_EQ(analysis::unresolved(of_slow), 1);
}

// A ramp is no sum of lines: what is fitted to it must not run away towards a constant.
TEST(Spectrum, StaysBoundedWhereThereAreNoLines) {
  std::vector<double> x;
  for (int k = 0; k < count; ++k) x.push_back(std::tanh(0.01 * (k - 5000)) + 1e-4 * k);
  const analysis::Spectrum found =
      analysis::spectrum(start, 1.0, std::span<const double>(x), {.lines = 6});
  for (const analysis::SpectralLine& line : found.lines) {
    EXPECT_LT(line.amplitude, 5.0);
    EXPECT_GT(line.frequency, 0.04 * apart);
  }
}

TEST(Spectrum, LeavesOutWhatIsSmall) {
  const std::vector<Known> all = {{0.2, 1.0, 0.0}, {0.5, 1e-3, 1.0}};
  EXPECT_THAT(analysis::spectrum(start, 1.0, sum_of(all), {.smallest = 1e-2}).lines, SizeIs(1));
  EXPECT_THAT(analysis::spectrum(start, 1.0, sum_of(all)).lines, SizeIs(2));
  const std::vector<double> constant(100, 2.5);
  const analysis::Spectrum none = analysis::spectrum(0.0, 1.0, std::span<const double>(constant));
  EXPECT_THAT(none.lines, IsEmpty());
  EXPECT_NEAR(none.mean, 2.5, budget::spectrum_amplitude);
}

TEST(Spectrum, NamesWhatIsWrong) {
  std::vector<double> x(100, 1.0);
  const auto of = [&](double interval, const analysis::SpectrumOptions& options) {
    return message_of(
        [&] { analysis::spectrum(0.0, interval, std::span<const double>(x), options); });
  };
  EXPECT_THAT(of(0.0, {}), HasSubstr("expected a positive one"));
  EXPECT_THAT(of(1.0, {.window = 6}), HasSubstr("got window 6; expected 0 to 5"));
  EXPECT_THAT(of(1.0, {.lines = 34}), HasSubstr("1 to 33 lines"));
  EXPECT_THAT(of(1.0, {.lines = 0}), HasSubstr("got 100 samples for 0 lines"));
  x[7] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(of(1.0, {}), HasSubstr("sample 7 that is not finite"));
  x.resize(5);
  EXPECT_THAT(of(1.0, {.lines = 1}), HasSubstr("expected 8 samples or more"));
}

}  // namespace
