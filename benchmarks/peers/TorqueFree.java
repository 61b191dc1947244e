// SPDX-License-Identifier: MIT
// The algorithm of Orekit's TorqueFree on Hipparchus, restated: sn, cn and dn by Hipparchus, the angle of
// precession by an integration of its rate over one period, whose dense output is asked. Without
// Orekit's dates and frames: a lower bound of what its users wait.
//
// Arguments: a file of numbers: three moments, the momentum in body axes, times. The attitude at t = 0 is 1.
// Prints a row of q (w, x, y, z), omega for each of the first 65 times; then, for each line of standard
// input, nanoseconds a state ("states") or a preparation ("prepare") in time of the thread.
import java.io.BufferedReader;
import java.io.InputStreamReader;
import java.lang.management.ManagementFactory;
import java.nio.file.Files;
import java.nio.file.Paths;
import org.hipparchus.ode.DenseOutputModel;
import org.hipparchus.ode.ODEState;
import org.hipparchus.ode.OrdinaryDifferentialEquation;
import org.hipparchus.ode.nonstiff.DormandPrince853Integrator;
import org.hipparchus.special.elliptic.jacobi.CopolarN;
import org.hipparchus.special.elliptic.jacobi.JacobiElliptic;
import org.hipparchus.special.elliptic.jacobi.JacobiEllipticBuilder;
import org.hipparchus.special.elliptic.legendre.LegendreEllipticIntegral;
import org.hipparchus.util.FastMath;
import org.hipparchus.util.SinCos;

final class TorqueFree {
  private final double A, B, C, G, a1, a2, a3, n, u0, period, turn;
  private final boolean swapped, turned;
  private final JacobiElliptic jacobi;
  private final DenseOutputModel precession;

  // Axes are renamed so that the momentum goes round the third one, on its positive side.
  TorqueFree(double[] I, double[] g) {
    double x = g[0], y = g[1], z = g[2];
    swapped = x * x * (I[0] - I[1]) / I[0] + z * z * (I[2] - I[1]) / I[2] < 0;
    A = swapped ? I[2] : I[0];
    B = I[1];
    C = swapped ? I[0] : I[2];
    if (swapped) {
      final double other = x;
      x = z;
      z = other;
      y = -y;
    }
    turned = z < 0;
    if (turned) {
      y = -y;
      z = -z;
    }
    final double DA = y * y * (B - A) / B + z * z * (C - A) / C;
    final double DC = x * x * (C - A) / A + y * y * (C - B) / B;
    G = FastMath.sqrt(x * x + y * y + z * z);
    a1 = FastMath.sqrt(A * DC / (C - A));
    a2 = FastMath.sqrt(B * DC / (C - B));
    a3 = FastMath.sqrt(C * DA / (C - A));
    final double rate = FastMath.sqrt((C - B) * DA / (A * B * C));
    n = swapped ? -rate : rate;
    final double m = (B - A) * DC / ((C - B) * DA);
    jacobi = JacobiEllipticBuilder.build(m);
    u0 = LegendreEllipticIntegral.bigF(FastMath.atan2(y / a2, x / a1), m);
    period = 2 * LegendreEllipticIntegral.bigK(m) / rate;
    precession = overOnePeriod();
    turn = precession.getInterpolatedState(period).getPrimaryState()[0];
  }

  private double precessionRate(double t) {
    final CopolarN f = jacobi.valuesN(u0 + n * t);
    final double x = a1 * f.cn(), y = a2 * f.sn();
    return G * (x * x / A + y * y / B) / (x * x + y * y);
  }

  private DenseOutputModel overOnePeriod() {
    final DenseOutputModel dense = new DenseOutputModel();
    final DormandPrince853Integrator integrator =
        new DormandPrince853Integrator(1e-6 * period, 1e-2 * period, 1e-16, 1e-16);
    integrator.addStepHandler(dense);
    integrator.integrate(new OrdinaryDifferentialEquation() {
      @Override
      public int getDimension() {
        return 1;
      }
      @Override
      public double[] computeDerivatives(double t, double[] phi) {
        return new double[] {precessionRate(t)};
      }
    }, new ODEState(0, new double[] {0}), period);
    return dense;
  }

  private static double[] product(double[] a, double[] b) {
    return new double[] {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
                         a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
                         a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
                         a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
  }

  private double[] axes() {
    final double h = FastMath.sqrt(0.5);
    final double[] swap = swapped ? new double[] {0, h, 0, h} : new double[] {1, 0, 0, 0};
    return turned ? product(new double[] {0, 1, 0, 0}, swap) : swap;
  }

  double[] at(double t) {
    final CopolarN f = jacobi.valuesN(u0 + n * t);
    double x = a1 * f.cn(), y = a2 * f.sn(), z = a3 * f.dn();
    final double periods = FastMath.floor(t / period);
    final double node = periods * turn
        + precession.getInterpolatedState(t - periods * period).getPrimaryState()[0];
    final double across = FastMath.sqrt(x * x + y * y);
    final SinCos a = FastMath.sinCos(0.5 * node);
    final SinCos b = FastMath.sinCos(0.5 * FastMath.atan2(across, z));
    final SinCos c = FastMath.sinCos(0.5 * FastMath.atan2(x, y));
    final double[] q = product(product(product(new double[] {a.cos(), 0, 0, a.sin()},
                                               new double[] {b.cos(), b.sin(), 0, 0}),
                                       new double[] {c.cos(), 0, 0, c.sin()}), axes());
    x /= A;
    y /= B;
    z /= C;
    if (turned) {
      y = -y;
      z = -z;
    }
    return swapped ? new double[] {q[0], q[1], q[2], q[3], z, -y, x}
                   : new double[] {q[0], q[1], q[2], q[3], x, y, z};
  }

  private static long threadNanoseconds() {
    return ManagementFactory.getThreadMXBean().getCurrentThreadCpuTime();
  }

  private static double kept = 0;

  // Until `least` nanoseconds are full.
  private static double measured(boolean prepare, double[] I, double[] g, double[] t, long least) {
    final TorqueFree motion = new TorqueFree(I, g);
    long units = 0;
    final long begin = threadNanoseconds();
    long passed;
    do {
      if (prepare) {
        kept += new TorqueFree(I, g).turn;
        ++units;
      } else {
        for (final double x : t) kept += motion.at(x)[0];
        units += t.length;
      }
      passed = threadNanoseconds() - begin;
    } while (passed < least);
    return (double) passed / units;
  }

  public static void main(String[] arguments) throws Exception {
    final double[] all = Files.readString(Paths.get(arguments[0])).trim().lines()
        .mapToDouble(Double::parseDouble).toArray();
    final double[] I = java.util.Arrays.copyOfRange(all, 0, 3);
    final double[] g = java.util.Arrays.copyOfRange(all, 3, 6);
    final double[] t = java.util.Arrays.copyOfRange(all, 6, all.length);
    final TorqueFree motion = new TorqueFree(I, g);
    final StringBuilder rows = new StringBuilder();
    for (int k = 0; k < 65; ++k) {
      rows.append(t[k]);
      for (final double x : motion.at(t[k])) rows.append(' ').append(x);
      rows.append('\n');
    }
    System.out.print(rows);
    measured(false, I, g, t, 2_000_000_000L);  // until the machine has compiled it
    measured(true, I, g, t, 1_000_000_000L);
    System.out.println("ready");
    System.out.flush();
    final BufferedReader in = new BufferedReader(new InputStreamReader(System.in));
    for (String line = in.readLine(); line != null; line = in.readLine()) {
      System.out.println(measured(line.equals("prepare"), I, g, t, 50_000_000L));
      System.out.flush();
    }
    if (kept == 0.123) System.out.println(kept);
  }
}
