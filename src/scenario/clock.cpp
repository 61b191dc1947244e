// SPDX-License-Identifier: MIT
#include "scenario/detail/clock.hpp"

#include <charconv>
#include <cmath>
#include <string>

#include "polhode/error.hpp"
#include "polhode/scenario/scenario.hpp"
#include "polhode/text/units.hpp"
#include "scenario/tables/state.hpp"
#include "text/dates.hpp"
#include "text/number_text.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

constexpr std::size_t longest_word = 100;

}  // namespace

namespace detail {

Clock clock_of(const FileValues& file, std::string_view path) {
  const Placed<StateTable> state = state_table(file);
  if (!state->epoch)
    refuse(file.values, path, file.name, "expected a key state.epoch, the date of t = 0");
  std::optional<double> dut1;
  const double second = built(file.values, path, file.name,
                              [&] { return file.units.to_core(1.0, "s", Dimension::time); });
  if (state->dut1) dut1 = *state->dut1 / second;
  const ephemeris::Date epoch = state.built<&StateTable::epoch>([&] {
    const ephemeris::Date own = epoch_date(*state->epoch);
    if (own.scale == ephemeris::TimeScale::UT1 && !dut1)
      throw DomainError("expected a key state.dut1 as well: UT1 - UTC, which is observed");
    return ephemeris::converted(own, ephemeris::TimeScale::TT, dut1);
  });
  return {epoch, dut1, second};
}

double time_of_date(const FileValues& file, const std::string& date) {
  const Placed<StateTable> state = state_table(file);
  if (!state->epoch) throw DomainError("a date needs epoch in [state], the date of t = 0");
  const std::string& epoch = *state->epoch;
  const double second = file.units.to_core(1.0, "s", Dimension::time);
  std::optional<double> dut1;
  if (state->dut1) dut1 = *state->dut1 / second;
  return second *
         ephemeris::seconds_between(epoch_date(epoch), epoch_date(with_scale(date, epoch)), dut1);
}

namespace {

std::string two_digits(int x) { return (x < 10 ? "0" : "") + std::to_string(x); }

}  // namespace

std::string time_and_date(const FileValues& file, double t) {
  const Units& units = file.units;
  std::string text = "t = " + polhode::detail::number_text(units.from_core(t, Dimension::time)) +
                     (units.time() == "1" ? "" : " " + units.time());
  const std::optional<std::string> dated = state_table(file)->epoch;
  if (!dated || !std::isfinite(t)) return text;
  try {
    const ephemeris::Date epoch = epoch_date(*dated);
    const ephemeris::TimeScale scale =
        epoch.scale == ephemeris::TimeScale::UT1 ? ephemeris::TimeScale::TT : epoch.scale;
    const Clock clock = clock_of(file, "state.epoch");
    const ephemeris::CalendarTime at = ephemeris::calendar_time(
        ephemeris::converted(ephemeris::date_after(clock.epoch, t / clock.second), scale));
    text += ", " + std::to_string(at.year) + "-" + two_digits(at.month) + "-" + two_digits(at.day) +
            "T" + two_digits(at.hour) + ":" + two_digits(at.minute) + " " +
            std::string(ephemeris::name(scale));
  } catch (const DomainError&) {  // a year without a calendar
  }
  return text;
}

}  // namespace detail

double time_of_word(const Scenario& scenario, const std::string& word) {
  double number = 0.0;
  const char* const end = word.data() + word.size();
  const auto [after, error] = std::from_chars(word.data(), end, number);
  std::string why;
  if (error == std::errc() && after == end) {
    if (std::isfinite(number)) return scenario.units().to_core(number, Dimension::time);
  } else if (!word.empty()) {
    try {
      return detail::time_of_date(detail::file_values(scenario.document), word);
    } catch (const DomainError& no_date) {
      why = std::string(": ") + no_date.what();
    }
  }
  throw DomainError("got \"" + detail::printable(word, longest_word) +
                    "\"; expected a time in the unit of the file, or a date" + why);
}

std::string date_of_time(const Scenario& scenario, double t) {
  const std::string text = detail::time_and_date(detail::file_values(scenario.document), t);
  const std::size_t comma = text.find(", ");
  return comma == std::string::npos ? "" : text.substr(comma + 2);
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
