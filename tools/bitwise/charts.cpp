// SPDX-License-Identifier: MIT
// Every chart, from a state and back, with its Jacobians: over states of every regime, and on and
// next to the poles of the charts.
#include "cases.hpp"
#include "record.hpp"

namespace {

using namespace polhode;
using probe::Case;
using probe::Record;

constexpr int of_each = 40;

template <std::size_t N>
void print_numbers(const Record& out, const std::string& field, const double (&numbers)[N]) {
  for (std::size_t i = 0; i < N; ++i) out.value(field + "[" + std::to_string(i) + "]", numbers[i]);
}

void print_attitudes(const Record& out, const RotorState& s) {
  const EulerAngles e = euler_angles(s.q);
  print_numbers(out, "euler_angles", {e.phi, e.theta, e.psi});
  out.quaternion("attitude(euler_angles)", attitude(e));
  const Mat3 R = attitude_matrix(s.q);
  out.matrix("attitude_matrix", R, 3);
  out.tried("attitude(matrix)", [&] { out.quaternion("attitude(matrix)", attitude(R)); });
}

void print_euler(const Record& out, const Body& body, const RotorState& s) {
  const EulerState e = to_euler(s);
  print_numbers(out, "euler", {e.phi, e.theta, e.psi, e.Phi, e.Theta, e.Psi});
  out.state("to_rotor(euler)", to_rotor(e));
  out.matrix("chart_jacobian(euler)", chart_jacobian(e), 6);
  const EulerRates r = to_euler_rates(body, s);
  print_numbers(out, "euler_rates", {r.phi, r.theta, r.psi, r.phi_dot, r.theta_dot, r.psi_dot});
  out.state("to_rotor(euler_rates)", to_rotor(body, r));
  out.matrix("chart_jacobian(euler_rates)", chart_jacobian(body, r), 6);
  out.matrix("inverse_chart_jacobian(euler_rates)", inverse_chart_jacobian(body, r), 6);
}

void print_andoyer(const Record& out, const Case& c, const Body& body, const RotorState& s) {
  const AndoyerState a = to_andoyer(s);
  print_numbers(out, "andoyer", {a.l, a.g, a.h, a.L, a.G, a.H});
  out.state("to_rotor(andoyer)", to_rotor(a));
  out.matrix("chart_jacobian(andoyer)", chart_jacobian(a), 6);
  const double t = c.t0 + 3.3 * c.turn;
  const AndoyerState m = charts::modified_andoyer(body, t, s, c.t0);
  print_numbers(out, "modified_andoyer", {m.l, m.g, m.h, m.L, m.G, m.H});
  out.state("from_modified_andoyer", charts::from_modified_andoyer(body, t, m, c.t0));
}

void print_poincare(const Record& out, const std::string& name, const PoincareState& p) {
  print_numbers(out, name, {p.sigma, p.Q1, p.Q2, p.G, p.P1, p.P2});
  out.state("to_rotor(" + name + ")", to_rotor(p));
  out.matrix("chart_jacobian(" + name + ")", chart_jacobian(p), 6);
}

void print_canonical(const Record& out, const RotorState& s) {
  std::vector<std::pair<std::string, CanonicalChart>> charts{{"euler", {CanonicalSet::euler}},
                                                             {"andoyer", {CanonicalSet::andoyer}}};
  for (const Pole J : {Pole::zero, Pole::pi}) {
    for (const Pole I : {Pole::zero, Pole::pi}) {
      const std::string name =
          std::string("poincare-") + (J == Pole::pi ? "pi-" : "0-") + (I == Pole::pi ? "pi" : "0");
      print_poincare(out, name, to_poincare(s, J, I));
      charts.push_back({name, {CanonicalSet::poincare, J, I}});
    }
  }
  const PoincareState nearest = nearest_poincare(s);
  out.value("nearest_poincare.J", nearest.pole_J == Pole::pi);
  out.value("nearest_poincare.I", nearest.pole_I == Pole::pi);
  for (const auto& [name, chart] : charts) {
    out.matrix("chart_jacobian(" + name + ", state)", chart_jacobian(s, chart), 6);
    out.matrix("inverse_chart_jacobian(" + name + ")", inverse_chart_jacobian(s, chart), 6);
  }
  out.matrix("andoyer-to-euler", canonical_transformation(s, charts[1].second, charts[0].second),
             6);
}

void print_rates(const Record& out, const Body& body, const RotorState& s) {
  out.vector("angular_velocity", angular_velocity(body, s));
  out.vector("inertial_angular_velocity", inertial_angular_velocity(body, s));
  out.value("kinetic_energy", kinetic_energy(body, s));
  out.vector("inertial_momentum", inertial_momentum(s));
  out.matrix("body_rate_jacobian", body_rate_jacobian(body), 6);
  out.matrix("inverse_body_rate_jacobian", inverse_body_rate_jacobian(body), 6);
  out.matrix("inertial_rate_jacobian", inertial_rate_jacobian(body, s), 6);
  out.matrix("inverse_inertial_rate_jacobian", inverse_inertial_rate_jacobian(body, s), 6);
  const charts::RotorAxes axes = charts::inertial_axes(System(body), 0.0, s);
  print_numbers(out, "axes",
                {axes.figure.I, axes.figure.h, axes.momentum.I, axes.momentum.h, axes.rotation.I,
                 axes.rotation.h});
}

void print_serret(const Record& out, const Body& body, const FreeRotation& motion, double t) {
  const SerretState s = to_serret(motion, t);
  print_numbers(out, "serret", {s.g0, s.h, s.t0, s.G, s.H, s.T, 1.0 * s.sign_g1, 1.0 * s.sign_g3});
  out.state("to_rotor(serret)", to_rotor(body, s, t));
  out.state("free_rotation(serret)", free_rotation(body, s).at(t));
  out.matrix("chart_jacobian(serret)", chart_jacobian(body, s, t), 6);
}

void print_sadov(const Record& out, const Body& body, const FreeRotation& motion, double t) {
  const SadovState s = to_sadov(motion, t);
  print_numbers(out, "sadov",
                {s.phi_l, s.phi_g, s.phi_h, s.I_l, s.I_g, s.I_h, static_cast<double>(s.region),
                 static_cast<double>(s.lobe)});
  out.tried("sadov_frequencies", [&] {
    const SadovFrequencies n = sadov_frequencies(motion);
    print_numbers(out, "sadov_frequencies", {n.n_l, n.n_g});
  });
  out.state("to_rotor(sadov)", to_rotor(body, s));
  out.matrix("chart_jacobian(sadov)", chart_jacobian(body, s), 6);
}

void print_tumbler(const Record& out, const Body& body, const FreeRotation& motion, double t) {
  out.tried("psi_max", [&] { out.value("psi_max", psi_max(motion)); });
  const TumblerState s = to_tumbler(motion, t);
  print_numbers(out, "tumbler",
                {s.precession_period, s.rotation_period, s.pole.x, s.pole.y, s.pole.z,
                 static_cast<double>(s.mode), s.phi0, s.psi0, 1.0 * s.branch, 1.0 * s.sense});
  out.state("to_rotor(tumbler)", to_rotor(body, s));
}

void print_charts(const Record& out, const Case& c) {
  const Body body(c.moments[0], c.moments[1], c.moments[2]);
  const RotorState s{{c.q[0], c.q[1], c.q[2], c.q[3]}, {c.g[0], c.g[1], c.g[2]}};
  out.tried("attitudes", [&] { print_attitudes(out, s); });
  out.tried("euler", [&] { print_euler(out, body, s); });
  out.tried("andoyer", [&] { print_andoyer(out, c, body, s); });
  out.tried("canonical", [&] { print_canonical(out, s); });
  out.tried("rates", [&] { print_rates(out, body, s); });
  const FreeRotation motion(body, s, c.t0);
  const double t = c.t0 + 0.3 * c.turn;
  out.tried("serret", [&] { print_serret(out, body, motion, t); });
  out.tried("sadov", [&] { print_sadov(out, body, motion, t); });
  out.tried("tumbler", [&] { print_tumbler(out, body, motion, t); });
}

// In body axes: J and I down to 1e-160 from 0 and pi, or there. The nodes of the charts vanish.
Case near_poles(probe::Draw& d, int number) {
  Case c;
  c.name = "near-poles/" + std::to_string(number);
  c.moments = probe::triaxial(d);
  const double J = d.coin() ? d.power_of_ten(-160, -1) : 0.0, l = d.angle();
  const double G = d.power_of_ten(-3, 3);
  c.g = {G * std::sin(J) * std::sin(l), G * std::sin(J) * std::cos(l), d.sign() * G * std::cos(J)};
  c.q = probe::attitude(d);
  return c;
}

}  // namespace

int main() {
  std::vector<Case> all = probe::cases(of_each);
  probe::Draw draw(1000);
  for (int k = 0; k < 4 * of_each; ++k) all.push_back(near_poles(draw, k));
  for (const Case& c : all) {
    const Record out(c.name);
    out.tried("charts", [&] { print_charts(out, c); });
  }
}
