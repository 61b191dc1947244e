// SPDX-License-Identifier: MIT
// Time runs as tau from -1 to 1 along the samples: frequencies are in rad per tau, and phases those
// at the middle, where frequency and phase are independent. Real samples are complex ones of which
// the real part alone counts.
#include "polhode/analysis/spectrum.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <type_traits>
#include <unsupported/Eigen/FFT>
#include <utility>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace analysis {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

constexpr int most_iterations = 30;
constexpr double resolved = 10.0;  // turns along the samples between two lines

// c exp(i nu tau)
struct Line {
  double nu;
  Complex c = {};
  double peak = nu;        // where it was found
  bool is_frozen = false;  // there
};

class Analysis {
 public:
  Analysis(std::vector<Complex> samples, bool is_real, int lines, const SpectrumOptions& options)
      : x_(std::move(samples)), rest_(x_), is_real_(is_real), most_(lines), options_(options) {
    const double last = static_cast<double>(x_.size() - 1);
    for (std::size_t k = 0; k < x_.size(); ++k) {
      tau_.push_back((2.0 * static_cast<double>(k) - last) / last);
      weight_.push_back(std::pow(0.5 * (1.0 + std::cos(pi * tau_[k])), options.window));
    }
    // the ends would weigh nothing at all
    for (double& w : weight_) w = std::max(w, 1e-12);
  }

  void run() {
    if (is_real_) take_mean();
    fitted_ = size_of(rest_);
    for (int n = 0; n < most_; ++n) {
      double nu = refined(strongest_bin());
      // what is left near a line may be that the line is not fitted yet
      if (is_known(nu, resolved * pi) || size_of(rest_) < 0.1 * fitted_) {
        fit(most_iterations);
        nu = refined(strongest_bin());
      }
      if (!std::isfinite(nu) || is_known(nu, 0.5 * pi) || is_noise(nu)) break;
      lines_.push_back({nu});
      fit_amplitudes();
    }
    fit(most_iterations);
    if (leave_out_small()) fit(most_iterations);
  }

  Spectrum result(double start, double interval) const;

 private:
  static constexpr double nothing = std::numeric_limits<double>::epsilon();

  double size_of(const std::vector<Complex>& x) const {
    double sum = 0.0;
    for (const Complex& one : x) sum += std::norm(one);
    return std::sqrt(sum / static_cast<double>(x.size()));
  }
  bool is_noise(double nu) const {
    const double amplitude = std::abs(moments(nu)[0]);
    double largest = amplitude;
    for (const Line& line : lines_) largest = std::max(largest, std::abs(line.c));
    return size_of(rest_) <= 8.0 * nothing * size_of(x_) ||
           amplitude * (is_real_ ? 2.0 : 1.0) < options_.smallest * largest;
  }
  // Whether a line is closer; one closer than what a peak is wide, half a turn, is the same.
  bool is_known(double nu, double apart) const {
    return std::any_of(lines_.begin(), lines_.end(), [&](const Line& one) {
      return std::fabs(one.nu - nu) < apart || (is_real_ && std::fabs(one.nu + nu) < apart);
    });
  }
  bool leave_out_small() {
    double largest = 0.0;
    for (const Line& line : lines_) largest = std::max(largest, std::abs(line.c));
    return std::erase_if(lines_, [&](const Line& line) {
             return std::abs(line.c) < options_.smallest * largest;
           }) > 0;
  }

  void take_mean() {
    double sum = 0.0, of = 0.0;
    for (std::size_t k = 0; k < x_.size(); ++k) {
      sum += weight_[k] * rest_[k].real();
      of += weight_[k];
    }
    mean_ = sum / of;
    find_rest();
  }
  void find_rest() {
    for (std::size_t k = 0; k < x_.size(); ++k) {
      Complex sum = mean_;
      for (const Line& line : lines_) sum += line.c * std::polar(1.0, line.nu * tau_[k]);
      rest_[k] = is_real_ ? Complex(x_[k].real() - sum.real()) : x_[k] - sum;
    }
  }

  // The frequency at which the transform of what is left is largest.
  double strongest_bin() const {
    std::size_t size = 1;
    while (size < 4 * rest_.size()) size *= 2;
    std::vector<Complex> padded(size), of;
    for (std::size_t k = 0; k < rest_.size(); ++k) padded[k] = weight_[k] * rest_[k];
    Eigen::FFT<double> transform;
    transform.fwd(of, padded);
    // real samples have each line twice, and what is close to 0 is the mean's
    const std::size_t first = is_real_ ? std::max<std::size_t>(1, size / rest_.size()) : 0;
    const std::size_t last = is_real_ ? size / 2 : size;
    std::size_t best = first;
    for (std::size_t k = first; k < last; ++k)
      if (std::norm(of[k]) > std::norm(of[best])) best = k;
    const double turns = best < size / 2 ? static_cast<double>(best)
                                         : static_cast<double>(best) - static_cast<double>(size);
    bin_ = pi * static_cast<double>(rest_.size() - 1) / static_cast<double>(size);
    return turns * bin_;
  }

  // sum w tau^m rest exp(-i nu tau), m = 0, 1, 2, over the sum of w.
  std::array<Complex, 3> moments(double nu) const {
    std::array<Complex, 3> sums{};
    double of = 0.0;
    for (std::size_t k = 0; k < rest_.size(); ++k) {
      const Complex one = weight_[k] * rest_[k] * std::polar(1.0, -nu * tau_[k]);
      sums[0] += one;
      sums[1] += tau_[k] * one;
      sums[2] += tau_[k] * tau_[k] * one;
      of += weight_[k];
    }
    for (Complex& sum : sums) sum /= of;
    return sums;
  }

  // Newton's method for the maximum of |moments(nu)[0]|^2, not farther than a bin away.
  double refined(double start) const {
    double nu = start;
    for (int i = 0; i < most_iterations; ++i) {
      const auto [f, g, h] = moments(nu);
      // f' = -i g, f'' = -h
      const double slope = 2.0 * (std::conj(f) * g).imag();
      const double curve = 2.0 * (std::norm(g) - (std::conj(f) * h).real());
      if (!(curve < 0.0)) return start;
      const double next = std::clamp(nu - slope / curve, start - bin_, start + bin_);
      if (std::fabs(next - nu) <= 1e-13 * std::max(1.0, std::fabs(nu))) return next;
      nu = next;
    }
    return nu;
  }

  // The columns of a line in the equations of least squares, for the real and the imaginary part of
  // a sample: those of Re c, Im c and, where wanted, nu.
  struct Columns {
    double re[3];
    double im[3];
  };
  Columns columns(const Line& line, std::size_t k) const {
    const Complex u = std::polar(1.0, line.nu * tau_[k]), along = Complex(0, tau_[k]) * line.c * u;
    const double moves = line.is_frozen ? 0.0 : 1.0;
    return {{u.real(), -u.imag(), moves * along.real()},
            {u.imag(), u.real(), moves * along.imag()}};
  }

  struct Equations {
    Eigen::MatrixXd normal;
    Eigen::MatrixXd squared;  // with the squares of the weights
    Eigen::VectorXd right;
  };
  // `per_line` is 2 or 3; the mean of real samples comes last.
  Equations equations(Eigen::Index per_line, bool with_squares) const;
  void fit_amplitudes() {
    add(equations(2, false), 2, 1.0);
    find_rest();
  }
  double cost() const {
    double sum = 0.0;
    for (std::size_t k = 0; k < rest_.size(); ++k) sum += weight_[k] * std::norm(rest_[k]);
    return sum;
  }
  // Adds a share of the solution.
  double add(const Equations& of, Eigen::Index per_line, double share);
  void fit(int iterations);
  void fit_frequencies(int iterations);
  bool freeze();
  void isolate(Spectrum& into) const;

  std::vector<Complex> x_, rest_;
  std::vector<double> tau_, weight_;
  bool is_real_;
  int most_;  // lines
  SpectrumOptions options_;
  double mean_ = 0.0;
  double fitted_ = 0.0;  // what was left after the last fit of everything
  std::vector<Line> lines_;
  mutable double bin_ = 0.0;
};

Analysis::Equations Analysis::equations(Eigen::Index per_line, bool with_squares) const {
  const auto lines = static_cast<Eigen::Index>(lines_.size());
  const Eigen::Index size = per_line * lines + (is_real_ ? 1 : 0);
  // blocks of rows keep the memory small and the products fast
  constexpr std::size_t block = 512;
  const Eigen::Index parts = is_real_ ? 1 : 2;
  Eigen::MatrixXd rows(size, static_cast<Eigen::Index>(block) * parts), weighed = rows;
  Eigen::VectorXd rest(rows.cols());
  Equations of{Eigen::MatrixXd::Zero(size, size), Eigen::MatrixXd::Zero(size, size),
               Eigen::VectorXd::Zero(size)};
  for (std::size_t first = 0; first < x_.size(); first += block) {
    rows.setZero();
    weighed.setZero();
    rest.setZero();
    for (std::size_t k = first; k < std::min(first + block, x_.size()); ++k) {
      const auto at = static_cast<Eigen::Index>(k - first) * parts;
      for (Eigen::Index i = 0; i < lines; ++i) {
        const Columns c = columns(lines_[static_cast<std::size_t>(i)], k);
        for (Eigen::Index j = 0; j < per_line; ++j) {
          rows(per_line * i + j, at) = c.re[j];
          if (!is_real_) rows(per_line * i + j, at + 1) = c.im[j];
        }
      }
      if (is_real_) rows(size - 1, at) = 1.0;
      for (Eigen::Index part = 0; part < parts; ++part) {
        weighed.col(at + part) = weight_[k] * rows.col(at + part);
        rest(at + part) = part == 0 ? rest_[k].real() : rest_[k].imag();
      }
    }
    of.normal.noalias() += weighed * rows.transpose();
    of.right.noalias() += weighed * rest;
    if (with_squares) of.squared.noalias() += weighed * weighed.transpose();
  }
  for (Eigen::Index i = 0; per_line == 3 && i < lines; ++i)
    if (lines_[static_cast<std::size_t>(i)].is_frozen) of.normal(3 * i + 2, 3 * i + 2) = 1.0;
  return of;
}

double Analysis::add(const Equations& of, Eigen::Index per_line, double share) {
  const Eigen::VectorXd step = share * of.normal.ldlt().solve(of.right);
  double largest = 0.0;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const Eigen::Index at = per_line * static_cast<Eigen::Index>(i);
    lines_[i].c += Complex(step(at), step(at + 1));
    if (per_line < 3) continue;
    lines_[i].nu += step(at + 2);
    largest = std::max(largest, std::fabs(step(at + 2)));
  }
  if (is_real_) mean_ += step(step.size() - 1);
  return largest;
}

// Lines that wander off where they were found stay there: as of a signal that is no sum of lines.
bool Analysis::freeze() {
  bool any = false;
  for (Line& line : lines_) {
    if (line.is_frozen || std::fabs(line.nu - line.peak) < 0.5 * pi) continue;
    line.nu = line.peak;
    line.is_frozen = any = true;
  }
  return any;
}

// Gauss-Newton; a step that makes things worse is taken back and halved.
void Analysis::fit(int iterations) {
  fit_frequencies(iterations);
  fitted_ = size_of(rest_);
}

void Analysis::fit_frequencies(int iterations) {
  if (lines_.empty()) return;
  for (int i = 0; i < iterations; ++i) {
    const std::vector<Line> before = lines_;
    const double mean = mean_, was = cost();
    const Equations of = equations(3, false);
    double share = 1.0, moved = 0.0;
    for (; share > 1e-3; share *= 0.5) {
      moved = add(of, 3, share);
      find_rest();
      if (cost() <= was) break;
      lines_ = before;
      mean_ = mean;
    }
    if (share <= 1e-3) {
      find_rest();
      return;
    }
    const bool is_frozen = freeze();
    if (is_frozen) find_rest();
    if (moved < 1e-11 && !is_frozen) return;
  }
}

// How far the next line is.
void Analysis::isolate(Spectrum& into) const {
  for (SpectralLine& line : into.lines) {
    line.isolation = is_real_ ? 2.0 * line.frequency : std::numeric_limits<double>::infinity();
    for (const SpectralLine& other : into.lines)
      if (&other != &line)
        line.isolation = std::min(line.isolation, std::fabs(line.frequency - other.frequency));
  }
}

Spectrum Analysis::result(double start, double interval) const {
  Spectrum made;
  made.mean = mean_;
  made.residual = size_of(rest_);
  std::vector<Complex> varying = x_;
  for (Complex& one : varying) one -= is_real_ ? mean_ : 0.0;
  made.size = size_of(varying);
  const double half = 0.5 * interval * static_cast<double>(x_.size() - 1);  // of one tau
  const double middle = start + half;
  // as of noise with the size of what is left
  Eigen::VectorXd variance;
  if (!lines_.empty()) {
    const Equations of = equations(3, true);
    const Eigen::MatrixXd inverse =
        of.normal.ldlt().solve(Eigen::MatrixXd::Identity(of.normal.rows(), of.normal.cols()));
    const double each = made.residual * made.residual / (is_real_ ? 1.0 : 2.0);
    variance = each * (inverse * of.squared * inverse).diagonal();
  }
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    Line line = lines_[i];
    if (is_real_ && line.nu < 0.0) line = {-line.nu, std::conj(line.c), -line.nu, line.is_frozen};
    const auto at = static_cast<Eigen::Index>(3 * i);
    const double amplitude = std::abs(line.c), nu = line.nu / half;
    const double of_c = std::sqrt(std::max(0.0, 0.5 * (variance(at) + variance(at + 1))));
    made.lines.push_back(
        {nu, amplitude, std::remainder(std::arg(line.c) - nu * middle, 2.0 * pi),
         (line.is_frozen ? 0.5 * pi : std::sqrt(std::max(0.0, variance(at + 2)))) / half, of_c,
         of_c / amplitude, 0.0});
  }
  std::stable_sort(
      made.lines.begin(), made.lines.end(),
      [](const SpectralLine& a, const SpectralLine& b) { return a.amplitude > b.amplitude; });
  made.resolution = resolved * pi / half;
  isolate(made);
  return made;
}

// The power of two by which samples are divided, since squares and their products are taken: 0
// unless these would leave the range of double.
int exponent_of(const std::vector<Complex>& samples) {
  constexpr int most = 200;
  double largest = 0.0;
  for (const Complex& x : samples)
    for (const double part : {x.real(), x.imag()}) largest = std::max(largest, std::fabs(part));
  const int exponent = largest > 0.0 ? std::ilogb(largest) : 0;
  return std::abs(exponent) > most ? exponent : 0;
}
void scale(std::vector<Complex>& samples, int exponent) {
  if (exponent == 0) return;
  for (Complex& x : samples) x = {std::ldexp(x.real(), exponent), std::ldexp(x.imag(), exponent)};
}
void scale(Spectrum& of, int exponent) {
  if (exponent == 0) return;
  for (double* const x : {&of.mean, &of.residual, &of.size}) *x = std::ldexp(*x, exponent);
  for (SpectralLine& line : of.lines)
    for (double* const x : {&line.amplitude, &line.amplitude_error}) *x = std::ldexp(*x, exponent);
}

template <class Sample>
Spectrum analysed(double start, double interval, std::span<const Sample> samples,
                  const SpectrumOptions& options) {
  constexpr bool is_real = std::is_same_v<Sample, double>;
  const std::string got = "spectrum: got ";
  if (!(interval > 0.0) || !std::isfinite(interval) || !std::isfinite(start))
    throw DomainError(got + "interval " + polhode::detail::number_text(interval) + " from " +
                      polhode::detail::number_text(start) +
                      "; expected a positive one, and finite times");
  if (options.window < 0 || options.window > 5)
    throw DomainError(got + "window " + std::to_string(options.window) + "; expected 0 to 5");
  std::vector<Complex> values;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    values.emplace_back(samples[k]);
    if (!std::isfinite(values[k].real()) || !std::isfinite(values[k].imag()))
      throw DomainError(got + "sample " + std::to_string(k) +
                        " that is not finite; expected finite ones");
  }
  const int most = static_cast<int>(samples.size() * (is_real ? 1 : 2) / 3);
  const int lines = options.lines.value_or(std::clamp(most, 1, 20));
  if (samples.size() < 8 || lines < 1 || lines > most)
    throw DomainError(got + std::to_string(samples.size()) + " samples for " +
                      std::to_string(lines) + (lines == 1 ? " line" : " lines") +
                      "; expected 8 samples or more, and 1 to " +
                      std::to_string(std::max(most, 1)) + " lines with so many");
  const int exponent = exponent_of(values);
  scale(values, -exponent);
  Analysis analysis(std::move(values), is_real, lines, options);
  analysis.run();
  Spectrum found = analysis.result(start, interval);
  scale(found, exponent);
  return found;
}

}  // namespace

int unresolved(const Spectrum& of) {
  return static_cast<int>(
      std::count_if(of.lines.begin(), of.lines.end(),
                    [&](const SpectralLine& line) { return line.isolation < of.resolution; }));
}

Spectrum spectrum(double start, double interval, std::span<const double> samples,
                  const SpectrumOptions& options) {
  return analysed(start, interval, samples, options);
}
Spectrum spectrum(double start, double interval, std::span<const Complex> samples,
                  const SpectrumOptions& options) {
  return analysed(start, interval, samples, options);
}

}  // namespace analysis
}  // namespace v0
}  // namespace polhode
