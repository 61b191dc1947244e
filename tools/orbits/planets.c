// SPDX-License-Identifier: MIT
// The orbits of Mars and of the Earth-Moon barycentre over millions of years, by REBOUND's WHFast.
//
//   planets STATES YEARS SHIFT > SUMS
//
// STATES  lines "gm x y z vx vy vz" of the Sun and the planets, barycentric, axes ecliptic-J2000;
//         au and days. The third planet is the Earth-Moon barycentre, the fourth Mars.
// YEARS   how far; negative: into the past.
// SHIFT   moves Mars by so much along axis 1 at the start, in au: a clone.
// SUMS    lines "j weight a k h q p a k h q p", Earth then Mars: sums of the heliocentric elements
//         with the weight cos^4(pi tau / 2 W) of W = 400 years around j centuries. Runs into the past
//         and the future each have a part of those around t = 0; reduce.py joins them.
//
// Forces besides Newton's: the relativistic potential of the Sun, -3 (gm / (c r))^2 (Nobili &
// Roxburgh 1986); the quadrupole of the Moon's orbit, averaged (Quinn, Tremaine & Duncan 1991), times 0.8525, since
// the Moon's orbit is no circle in the ecliptic (Varadi, Runnegar & Ghil 2003).
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "rebound.h"

enum { EARTH = 3, MARS = 4, VALUES = 5, RING = 2048, STEPS_A_SAMPLE = 61 };

static const double step = 5.0;             // days
static const double year = 365.25;          // days
static const double spacing = 100 * 365.25; // of the output
static const double window = 400 * 365.25;  // its half-width
static const double light_speed = 173.14463267424034;  // au / day
// (m_E m_M / (m_E + m_M)^2) d^2 f of the Earth and the Moon: masses of DE440, d = 384400 km, f =
// 0.8525.
static const double lunar_quadrupole = 0.0120030 * 0.8525 * (384400.0 / 149597870.7) *
                                       (384400.0 / 149597870.7);

static void other_forces(struct reb_simulation* r) {
  struct reb_particle* const p = r->particles;
  const double gm = p[0].m;
  for (size_t i = 1; i < r->N; ++i) {
    const double x = p[i].x - p[0].x, y = p[i].y - p[0].y, z = p[i].z - p[0].z;
    const double r2 = x * x + y * y + z * z;
    double factor = -6.0 * gm * gm / (light_speed * light_speed * r2 * r2);
    if (i == EARTH) factor -= 0.75 * gm * lunar_quadrupole / (r2 * r2 * sqrt(r2));
    p[i].ax += factor * x;
    p[i].ay += factor * y;
    p[i].az += factor * z;
    const double back = factor * p[i].m / gm;
    p[0].ax -= back * x;
    p[0].ay -= back * y;
    p[0].az -= back * z;
  }
}

// a, and k, h, q, p as in polhode/secular/orbit_history.hpp.
static void elements(const struct reb_particle* sun, const struct reb_particle* body, double* out) {
  const double mu = sun->m + body->m;
  const double x = body->x - sun->x, y = body->y - sun->y, z = body->z - sun->z;
  const double u = body->vx - sun->vx, v = body->vy - sun->vy, w = body->vz - sun->vz;
  const double r = sqrt(x * x + y * y + z * z), v2 = u * u + v * v + w * w;
  const double lx = y * w - z * v, ly = z * u - x * w, lz = x * v - y * u;
  const double l = sqrt(lx * lx + ly * ly + lz * lz);
  const double ex = (v * lz - w * ly) / mu - x / r, ey = (w * lx - u * lz) / mu - y / r,
               ez = (u * ly - v * lx) / mu - z / r;
  // n = (sin i sin Omega, -sin i cos Omega, cos i); q + ip = sin(i/2) exp(i Omega)
  const double nx = lx / l, ny = ly / l, nz = lz / l, c = sqrt(0.5 * (1.0 + nz));
  const double q = -ny / (2.0 * c), p = nx / (2.0 * c);
  // equinoctial axes: the reference axes turned about the node by i
  const double fx = 1.0 - 2.0 * p * p, fy = 2.0 * p * q, fz = -2.0 * p * c;
  const double gx = fy, gy = 1.0 - 2.0 * q * q, gz = 2.0 * q * c;
  out[0] = 1.0 / (2.0 / r - v2 / mu);
  out[1] = ex * fx + ey * fy + ez * fz;
  out[2] = ex * gx + ey * gy + ez * gz;
  out[3] = q;
  out[4] = p;
}

struct Sample {
  double t;
  double of[2 * VALUES];
};

static void print_sums(const struct Sample* ring, long count, long j) {
  double sums[2 * VALUES + 1] = {0};
  for (long k = count > RING ? count - RING : 0; k < count; ++k) {
    const struct Sample* const s = &ring[k % RING];
    const double tau = (s->t - (double)j * spacing) / window;
    if (fabs(tau) >= 1.0) continue;
    const double c = cos(0.5 * M_PI * tau), weight = c * c * c * c;
    sums[0] += weight;
    for (int i = 0; i < 2 * VALUES; ++i) sums[i + 1] += weight * s->of[i];
  }
  printf("%ld", j);
  for (int i = 0; i < 2 * VALUES + 1; ++i) printf(" %.15g", sums[i]);
  putchar('\n');
}

int main(int argc, char** argv) {
  if (argc != 4) return fprintf(stderr, "planets STATES YEARS SHIFT\n"), 2;
  FILE* const states = fopen(argv[1], "r");
  if (states == NULL) return perror(argv[1]), 1;
  const double years = atof(argv[2]), shift = atof(argv[3]);
  struct reb_simulation* const r = reb_simulation_create();
  struct reb_particle body;
  memset(&body, 0, sizeof body);
  while (fscanf(states, "%lf %lf %lf %lf %lf %lf %lf", &body.m, &body.x, &body.y, &body.z, &body.vx,
                &body.vy, &body.vz) == 7)
    reb_simulation_add(r, body);
  fclose(states);
  r->particles[MARS].x += shift;
  reb_simulation_move_to_com(r);
  r->G = 1.0;
  r->dt = years < 0.0 ? -step : step;
  r->additional_forces = other_forces;
  struct reb_integrator_whfast_state* const whfast = reb_simulation_set_integrator(r, "whfast");
  whfast->safe_mode = 0;
  whfast->corrector = 17;  // at the start; what is sampled is averaged over a thousand samples
  const double energy = reb_simulation_energy(r);

  static struct Sample ring[RING];
  const double end = fabs(years) * year;
  long count = 0, j = -4;
  double worst = 0.0;
  for (double t = 0.0; t <= end; ++count) {
    struct Sample* const s = &ring[count % RING];
    s->t = t;
    elements(&r->particles[0], &r->particles[EARTH], s->of);
    elements(&r->particles[0], &r->particles[MARS], s->of + VALUES);
    if (years < 0.0 && count == 0) s->t = -1e30;  // the run forwards has it
    for (; t >= (double)j * spacing + window; ++j) print_sums(ring, count + 1, j);
    if (count % 1000000 == 0) {
      worst = fmax(worst, fabs(reb_simulation_energy(r) / energy - 1.0));
      fprintf(stderr, "%.3f Myr, energy off by %.1e\n", t / year * 1e-6, worst);
    }
    reb_simulation_steps(r, STEPS_A_SAMPLE);
    whfast->corrector = 0;
    reb_simulation_synchronize(r);
    t = fabs(r->t);
  }
  fprintf(stderr, "done: %.6f Myr\n", r->t / year * 1e-6);
  reb_simulation_free(r);
  return 0;
}
