// A diagnosis in words: what the terminal and the report both say.
#pragma once

#include <string>
#include <vector>

#include "core/diagnosis/diagnosis.h"

namespace odolab {

// "a, b and c", with the word that comes before the last.
std::string list_of(const std::vector<std::string>& words, const char* last_word);

// Of the data: a tracked point that sat elsewhere in one recording is a fault of that one.
bool is_fault(const Finding& finding);

// What is measured otherwise than the vehicle's file says, and not driven otherwise.
bool is_of_the_measurement(const Finding& finding);

// "3.41 mm, 0.401 degrees".
// Whether anything that was found is switched on in the simulator: where nothing is it does the same to the last digit.
bool is_switched_on(const FitTable& simulation);

std::string figures_text(const FitFigures& figures);

// "wheel eccentricity of the left wheel".
std::string effect_text(const std::string& effect, const std::string& component);

// "6.00 ± 0.10 mm": lengths in millimetres, angles in degrees, fractions in per cent, as many digits as the error
// bears.
std::string quantity_text(double value, double stderr_value, const std::string& unit);

// "0.17 %": two digits of a size that is known no better.
std::string size_text(double value, const std::string& unit);

// "0.17 mm, 0.021 degrees".
std::string moved_text(const MovedTrack& moved);

// "in run_3.csv, 3.75 to 7.25 s; within 0.70 m of (2.20, 0.10) m; in turns"; empty where nothing applies.
std::string where_text(const WhereFound& where);

// Findings as a page shows them: faults of one kind, in several recordings or wheels, are one.
std::vector<Finding> faults_together(const std::vector<Finding>& findings);

// Warnings that say the same of several recordings, but for their figures, as one, with the figures of the first.
std::vector<std::string> merged_warnings(const std::vector<std::string>& warnings);

// The summary that a person reads in a minute on a terminal: `most_lines` lines at most, each fit for `columns`.
std::vector<std::string> summary_lines(const Diagnosis& diagnosis, std::size_t most_lines = 25,
                                       std::size_t columns = 110);

}  // namespace odolab
