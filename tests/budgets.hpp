// SPDX-License-Identifier: MIT
// Every tolerance of every test, by name: one header a layer. Nothing is typed in a test.
#pragma once

#include "budgets/analysis.hpp"
#include "budgets/cli.hpp"
#include "budgets/dynamics.hpp"
#include "budgets/elliptic.hpp"
#include "budgets/ensemble.hpp"
#include "budgets/ephemeris.hpp"
#include "budgets/frame.hpp"
#include "budgets/free.hpp"
#include "budgets/io.hpp"
#include "budgets/math.hpp"
#include "budgets/ode.hpp"
#include "budgets/orbit.hpp"
#include "budgets/paper.hpp"
#include "budgets/perturb.hpp"
#include "budgets/python.hpp"
#include "budgets/rotor.hpp"
#include "budgets/secular.hpp"
#include "budgets/series.hpp"
#include "budgets/shape.hpp"
#include "budgets/system.hpp"
