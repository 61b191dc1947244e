// SPDX-License-Identifier: MIT
#include "polhode/text/units.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numbers>
#include <string>
#include <thread>
#include <vector>

#include "message_of.hpp"
#include "polhode/error.hpp"

namespace polhode {
namespace {

using test::message_of;

TEST(Units, CoreUnitsAreTheFilesTimeAndRadians) {
  const Units units("h", "deg", "kg m2");
  EXPECT_EQ(units.to_core(27.38, Dimension::time), 27.38);
  EXPECT_EQ(units.to_core(180.0, Dimension::angle), std::numbers::pi);
  EXPECT_EQ(units.to_core(180.0, Dimension::rate), std::numbers::pi);
  EXPECT_EQ(units.to_core(3.0, Dimension::momentum), 3.0);
  EXPECT_EQ(units.from_core(std::numbers::pi, Dimension::rate), 180.0);
}

TEST(Units, TheUnitOfTheFileChangesNoBit) {
  const Units units("d", "deg", "kg m2");
  const double value = 0.1 + 0.2;
  EXPECT_EQ(units.to_core(value, "d", Dimension::time), value);
  EXPECT_EQ(units.to_core(value, "rad", Dimension::angle), value);
  EXPECT_EQ(units.to_core(value, "kg m2", Dimension::moment), value);
  EXPECT_EQ(units.to_core(value, "kg m2/d", Dimension::momentum), value);
  EXPECT_EQ(units.to_core(value, "kg m2/d2", Dimension::energy), value);
}

TEST(Units, WholeRatiosAreRoundedOnce) {
  const Units units("d");
  EXPECT_EQ(units.to_core(1.0, "h", Dimension::time), 1.0 / 24.0);
  EXPECT_EQ(units.to_core(7.0, "s", Dimension::time), 7.0 / 86400.0);
  EXPECT_EQ(units.to_core(2.0, "yr", Dimension::time), 730.5);
  EXPECT_EQ(units.to_core(1.0, "Myr", Dimension::time), 365.25e6);
  EXPECT_EQ(units.to_core(1.0, "cy", Dimension::time), 36525.0);
}

TEST(Units, ProductsPowersAndQuotients) {
  const Units si("s", "rad", "kg m2");
  EXPECT_DOUBLE_EQ(si.to_core(1.0, "rpm", Dimension::rate), std::numbers::pi / 30.0);
  EXPECT_DOUBLE_EQ(si.to_core(360.0, "deg/h", Dimension::rate), std::numbers::pi / 1800.0);
  EXPECT_DOUBLE_EQ(si.to_core(2.0, "N m s", Dimension::momentum), 2.0);
  EXPECT_DOUBLE_EQ(si.to_core(2.0, "kg m2 rad/s", Dimension::momentum), 2.0);
  EXPECT_DOUBLE_EQ(si.to_core(2.0, "N m", Dimension::energy), 2.0);
  EXPECT_DOUBLE_EQ(si.to_core(2.0, "J", Dimension::energy), 2.0);
  EXPECT_DOUBLE_EQ(si.to_core(1e7, "g cm2", Dimension::moment), 1.0);
  EXPECT_DOUBLE_EQ(si.to_core(1.0, "kg km^2", Dimension::moment), 1e6);
  EXPECT_DOUBLE_EQ(Units("h").to_core(1.0, "1/s", Dimension::momentum), 3600.0);
}

TEST(Units, GravityTorqueAndDamping) {
  const Units km("s", "deg", "kg m2", "km");
  EXPECT_EQ(km.to_core(398600.4418, Dimension::gm), 398600.4418);
  EXPECT_EQ(km.to_core(398600.4418, "km3/s2", Dimension::gm), 398600.4418);
  EXPECT_DOUBLE_EQ(km.to_core(398600.4418e9, "m3/s2", Dimension::gm), 398600.4418);
  EXPECT_DOUBLE_EQ(Units("h", "rad", "1", "m").to_core(1.0, "km3/s2", Dimension::gm),
                   1e9 * 3600.0 * 3600.0);
  EXPECT_DOUBLE_EQ(Units("h").to_core(1.0, "1/s2", Dimension::gm), 3600.0 * 3600.0);
  EXPECT_DOUBLE_EQ(km.to_core(1.0, "R_e", Dimension::length), 6378.1366);
  EXPECT_DOUBLE_EQ(km.to_core(2.0, "N m", Dimension::torque), 2.0);
  EXPECT_DOUBLE_EQ(km.to_core(2.0, "N m s", Dimension::damping), 2.0);
  EXPECT_DOUBLE_EQ(km.to_core(2.0, "N m s/rad", Dimension::damping), 2.0);
  EXPECT_MESSAGE(
      km.to_core(1.0, "km2/s2", Dimension::gm),
      "\"km2/s2\" is not a unit of gravitational parameter here; expected one like km3/s2");
  EXPECT_MESSAGE(
      Units().to_core(1.0, "km", Dimension::length),
      "\"km\" is not a unit of length here; expected one like 1; set units.length = \"m\"");
}

TEST(Units, RootsOfMomentaAreWrittenAsRoots) {
  const Units si("s", "deg", "kg m2"), hours("h");
  EXPECT_EQ(si.label(Dimension::root_momentum), "sqrt(kg m2/s)");
  EXPECT_EQ(hours.label(Dimension::root_momentum), "sqrt(1/h)");
  EXPECT_EQ(si.to_core(0.1, Dimension::root_momentum), 0.1);
  EXPECT_EQ(si.from_core(0.1, Dimension::root_momentum), 0.1);
  EXPECT_EQ(si.to_core(0.1, "sqrt(kg m2/s)", Dimension::root_momentum), 0.1);
  EXPECT_EQ(hours.to_core(2.0, "sqrt(1/s)", Dimension::root_momentum), 120.0);
  EXPECT_DOUBLE_EQ(si.to_core(3.0, "sqrt(g m2 rad/s)", Dimension::root_momentum),
                   3.0 * std::sqrt(1e-3));
  for (const char* unit :
       {"kg m2/s", "sqrt(kg m2)", "sqrt()", "sqrt(", "sqrt(kg m2/s", "2 sqrt(1)"})
    EXPECT_THROW(si.to_core(1.0, unit, Dimension::root_momentum), DomainError) << unit;
  EXPECT_THROW(si.to_core(1.0, "sqrt(s2)", Dimension::time), DomainError);
  EXPECT_MESSAGE(si.to_core(1.0, "kg m2/s", Dimension::root_momentum),
                 "\"kg m2/s\" is not a unit of root of an angular momentum here; expected one like "
                 "sqrt(kg m2/s)");
  EXPECT_MESSAGE(hours.to_core(1.0, "sqrt(kg m2/s)", Dimension::root_momentum),
                 "\"sqrt(kg m2/s)\" is not a unit of root of an angular momentum here; expected "
                 "one like sqrt(1/h); set units.moment = \"kg m2\"");
}

TEST(Units, ReciprocalsAndOtherDimensionsAreRefused) {
  const Units units("h", "deg", "kg m2");
  EXPECT_MESSAGE(units.to_core(1.0, "1/s", Dimension::time),
                 "\"1/s\" is not a unit of time here; expected one like h");
  EXPECT_MESSAGE(units.to_core(1.0, "h/deg", Dimension::rate),
                 "\"h/deg\" is not a unit of angular rate here; expected one like deg/h");
  EXPECT_MESSAGE(
      units.to_core(1.0, "kg m2 deg/h", Dimension::moment),
      "\"kg m2 deg/h\" is not a unit of moment of inertia here; expected one like kg m2");
}

TEST(Units, UnknownUnitsNameTheNearest) {
  const Units units("h");
  const auto error = [&](const char* unit) {
    return message_of([&] { units.to_core(1.0, unit, Dimension::time); });
  };
  EXPECT_EQ(error("hour"), "unknown unit \"hour\"; did you mean h?");
  EXPECT_EQ(error("hours"), "unknown unit \"hours\"; did you mean h?");
  EXPECT_EQ(error("degrees/h"), "unknown unit \"degrees\"; did you mean deg?");
  EXPECT_EQ(error("mim"), "unknown unit \"mim\"; did you mean min?");
  // a multiple that is not there is no slip
  for (const char* unit : {"um", "dm", "Mm", "mPa", "kPa", "KPa", "mT", "ms", "pm", "micrometre",
                           "decimeter", "millisecond", "milliseconds", "kiloyear"})
    EXPECT_EQ(error(unit).find("did you mean"), std::string::npos) << unit << ": " << error(unit);
  EXPECT_EQ(error("nTesla"), "unknown unit \"nTesla\"; did you mean nT?");
  EXPECT_EQ(error("microtesla"), "unknown unit \"microtesla\"; did you mean uT?");
  EXPECT_EQ(error("centimeter"), "unknown unit \"centimeter\"; did you mean cm?");
  EXPECT_EQ(error("milimetre"), "unknown unit \"milimetre\"; did you mean mm?");
  EXPECT_EQ(error("minutes"), "unknown unit \"minutes\"; did you mean min?");
  EXPECT_EQ(error("metre"), "unknown unit \"metre\"; did you mean m?");
  EXPECT_EQ(error("Km"), "unknown unit \"Km\"; did you mean km?");
  EXPECT_EQ(error("Nm"), "unknown unit \"Nm\"; did you mean N m?");
  EXPECT_NE(error("fortnight").find("unknown unit \"fortnight\"; expected s, min"),
            std::string::npos);
}

TEST(Units, NothingButPlainUnitsReachesTheParser) {
  const Units units("s");
  for (const char* unit : {"s since 2000", "lg(re s)", "s @ 3", "60 s", "s 2", "1e300 s", "PI s",
                           "s^2^2", "(s", "", "ms", "h\n", "s^999999999", "\xc2\xb5s"})
    EXPECT_THROW(units.to_core(1.0, unit, Dimension::time), DomainError) << unit;
  EXPECT_THROW(units.to_core(1.0, std::string(4096, '('), Dimension::time), DomainError);
}

TEST(Units, FilesNameSingleUnitsOfTimeAndAngle) {
  EXPECT_MESSAGE(Units("1/h"), "time: \"1/h\" is not a single unit such as s, h or d");
  EXPECT_MESSAGE(Units("deg"), "time: \"deg\" is not a unit of time");
  EXPECT_MESSAGE(Units("s", "h"), "angle: \"h\" is not a unit of angle");
  EXPECT_MESSAGE(Units("s", "rad", "kg m"),
                 "moment: \"kg m\" is not 1 (scale-free) or a unit like kg m2");
  EXPECT_MESSAGE(Units("s", "rad", "1", "km2"),
                 "length: \"km2\" is not a single unit such as km, m or au");
  EXPECT_MESSAGE(Units("s", "rad", "1", "kg"),
                 "length: \"kg\" is not 1 (scale-free) or a unit like km");
}

TEST(Units, SmallLengthsAndPressures) {
  const Units si("s", "rad", "kg m2", "m");
  EXPECT_DOUBLE_EQ(si.to_core(1.0, "mm", Dimension::length), 1e-3);
  EXPECT_DOUBLE_EQ(si.to_core(1.0, "Pa", Dimension::pressure), 1.0);
  EXPECT_DOUBLE_EQ(si.to_core(1.0, "GPa", Dimension::pressure), 1e9);
  EXPECT_DOUBLE_EQ(si.to_core(1.0, "uT", Dimension::magnetic_field), 1e-6);
}

TEST(Units, OfSIAreCalledByTheirNames) {
  const Units si("s", "rad", "kg m2", "m");
  EXPECT_EQ(si.label(Dimension::pressure), "N/m2");
  EXPECT_EQ(si.label(Dimension::density), "kg/m3");
  EXPECT_EQ(si.label(Dimension::magnetic_field), "T");
  EXPECT_EQ(si.label(Dimension::mass), "kg");
  EXPECT_EQ(si.label(Dimension::magnetic_tensor), "S m4");
  EXPECT_EQ(Units("s", "rad", "kg m2", "km").label(Dimension::density), "kg m2/km5");
}

TEST(Units, AUnitThatIsMissingIsNamed) {
  const auto error = [](const Units& units, const char* unit, Dimension d) {
    return message_of([&] { units.to_core(1.0, unit, d); });
  };
  EXPECT_EQ(error(Units("s", "rad", "1", "km"), "kg/m3", Dimension::density),
            "\"kg/m3\" is not a unit of density here; expected one like 1/km5; set units.moment = "
            "\"kg m2\"");
  EXPECT_EQ(error(Units(), "nT", Dimension::magnetic_field),
            "\"nT\" is not a unit of magnetic field here; expected one like 1/(A s2); set "
            "units.moment = \"kg m2\" and units.length = \"m\"");
  EXPECT_EQ(error(Units(), "kg/m3", Dimension::time),
            "\"kg/m3\" is not a unit of time here; expected one like s");
}

TEST(Units, LabelsAreUnitsThemselves) {
  for (const Units& units : {Units("h", "deg", "kg m2", "km"), Units("d", "rev", "1", "au"),
                             Units(), Units("s", "rad", "kg m2", "m")})
    for (const Dimension d :
         {Dimension::time, Dimension::angle, Dimension::rate, Dimension::moment,
          Dimension::momentum, Dimension::energy, Dimension::length, Dimension::gm,
          Dimension::torque, Dimension::damping, Dimension::mass, Dimension::density,
          Dimension::pressure, Dimension::magnetic_field, Dimension::magnetic_tensor})
      EXPECT_EQ(units.to_core(1.0, units.label(d), d), units.to_core(1.0, d)) << units.label(d);
}

TEST(Quantity, IsANumberAndAUnit) {
  EXPECT_EQ(quantity_from_text("27.38 h").value, 27.38);
  EXPECT_EQ(quantity_from_text("  -1e3 kg m2/s ").unit, "kg m2/s");
  EXPECT_EQ(quantity_from_text("+5deg").value, 5.0);
  for (const char* text :
       {"", "h", "27.38", "nan h", "inf h", "1e999 h", "+-1 h", "--1 h", "one h"})
    EXPECT_THROW(quantity_from_text(text), DomainError) << text;
}

TEST(Units, OfTextAreReadByAnyThread) {
  std::vector<std::thread> threads;
  std::atomic<int> right = 0;
  for (int k = 0; k < 4; ++k)
    threads.emplace_back([&] {
      for (int i = 0; i < 50; ++i) {
        const Units units("h", "deg", "kg m2", "km");
        const bool refused =
            message_of([&] { units.to_core(1.0, "furlong", Dimension::length); }) != "";
        right += refused && units.to_core(3600.0, "km/h", Dimension::speed) == 3600.0;
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(right, 200);
}

}  // namespace
}  // namespace polhode
