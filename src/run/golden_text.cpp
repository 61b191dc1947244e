// SPDX-License-Identifier: MIT
// Golden cases as JSON and as CSV: what is given in the shortest form, which is exact; what is
// computed with 17 digits.
#include <charconv>

#include "polhode/run/golden.hpp"
#include "polhode/version.hpp"
#include "text/json.hpp"
#include "text/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using Numbers = std::vector<double>;

std::string digits17(double value) {
  char text[detail::longest_number];
  return std::string(text, std::to_chars(text, text + detail::longest_number, value,
                                         std::chars_format::general, 17)
                               .ptr);
}

Numbers numbers(const Vec3& v) { return {v.x, v.y, v.z}; }
Numbers numbers(const Quaternion& q) { return {q.w, q.x, q.y, q.z}; }

std::string joined(const Numbers& values, std::string_view comma,
                   std::string (*text)(double) = detail::number_text) {
  std::string line;
  for (const double value : values) {
    if (!line.empty()) line += comma;
    line += text(value);
  }
  return line;
}

std::string array(const Numbers& values, std::string (*text)(double) = detail::number_text) {
  return "[" + joined(values, ", ", text) + "]";
}

constexpr const char* q_meaning =
    "[w, x, y, z], Hamilton's product, body to inertial: v_inertial = q v_body q*; q and -q are "
    "one attitude, w >= 0 is written";
constexpr const char* omega_meaning = "body axes, radians per unit of time";
constexpr const char* bound_meaning =
    "|q - exact| <= bound and |omega - exact| <= bound |omega|, for moments, q0/|q0| and "
    "omega0_body exactly as written";

}  // namespace

std::string regime_name(Regime regime) {
  switch (regime) {
    case Regime::rest:
      return "rest";
    case Regime::steady:
      return "steady";
    case Regime::short_axis:
      return "short_axis";
    case Regime::long_axis:
      return "long_axis";
    case Regime::separatrix:
      return "separatrix";
  }
  return {};
}

std::string golden_json(const std::vector<GoldenCase>& cases) {
  detail::JsonWriter json;
  json.begin_object().key("title").value("Exact torque-free rotations of rigid bodies");
  json.key("polhode").value(version());
  json.key("meaning").begin_object();
  json.key("moments").value("principal moments of inertia about body axes 1, 2, 3");
  json.key("q").value(q_meaning).key("omega").value(omega_meaning);
  json.key("bound").value(bound_meaning).end_object();
  json.key("cases").begin_array();
  for (const GoldenCase& c : cases) {
    json.begin_object().key("name").value(c.name).key("description").value(c.description);
    json.key("regime").value(regime_name(c.regime));
    json.key("moments").raw(array(numbers(c.moments)));
    json.key("q0").raw(array(numbers(c.q0)));
    json.key("omega0_body").raw(array(numbers(c.omega0)));
    json.key("bound").value(c.bound);
    std::string rows;
    for (const GoldenSample& s : c.samples)
      rows += (rows.empty() ? "" : ",") + std::string("\n      {\"t\": ") +
              detail::number_text(s.t) + ", \"q\": " + array(numbers(s.q), digits17) +
              ", \"omega\": " + array(numbers(s.omega), digits17) + "}";
    json.key("samples").raw("[" + rows + "\n    ]").end_object();
  }
  json.end_array().end_object();
  return json.text();
}

std::string golden_csv(const std::vector<GoldenCase>& cases) {
  std::string csv = "# Exact torque-free rotations of rigid bodies. polhode ";
  csv += version();
  csv += "\n# moments: principal moments of inertia about body axes 1, 2, 3\n";
  for (const auto& [name, meaning] :
       {std::pair{"q", q_meaning}, {"omega", omega_meaning}, {"bound", bound_meaning}})
    csv += std::string("# ") + name + ": " + meaning + "\n";
  csv += "case,regime,I1,I2,I3,qw0,qx0,qy0,qz0,w10,w20,w30,bound,t,qw,qx,qy,qz,w1,w2,w3\n";
  for (const GoldenCase& c : cases) {
    const std::string start = c.name + "," + regime_name(c.regime) + "," +
                              joined(numbers(c.moments), ",") + "," + joined(numbers(c.q0), ",") +
                              "," + joined(numbers(c.omega0), ",") + "," +
                              detail::number_text(c.bound) + ",";
    for (const GoldenSample& s : c.samples)
      csv += start + detail::number_text(s.t) + "," + joined(numbers(s.q), ",", digits17) + "," +
             joined(numbers(s.omega), ",", digits17) + "\n";
  }
  return csv;
}

}  // namespace v0
}  // namespace polhode
