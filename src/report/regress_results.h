/// The result of a suite as files for programs and a table for people.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "report/regress.h"

namespace tyndall {

/// The object of results.json: version, suite, seed, machine, seconds, family_level, passed, failed, stopped, cases.
nlohmann::ordered_json regress_json(const SuiteResult& result);

/// JUnit XML as CI servers read it: a testsuite with one testcase a case; crashes, time-outs and errors are <error>,
/// pictures that differ <failure>.
std::string regress_junit(const SuiteResult& result);

/// One line of the table; `width`: letters of the longest name.
std::string regress_row(const CaseResult& result, std::size_t width);
std::string regress_head(std::size_t width);

/// "28 pass, 1 fail, 1 crash in 92 s".
std::string regress_summary(const SuiteResult& result);

}  // namespace tyndall
