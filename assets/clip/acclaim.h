// assets/clip/acclaim.h: motions in Acclaim's format: a skeleton (ASF) and what its bones do (AMC),
// as CMU's database has them. Not installed.
// Source: J. Lander, "Working with Motion Capture File Formats", and the ASF/AMC page of the
// University of Wisconsin's CS 838: a bone turns about where its parent ends, by C M C^-1, where C
// is its `axis` and M its degrees of freedom, in the order of their names, about fixed axes.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "articulated/clip.h"
#include "articulated/result.h"

namespace foretouch {

/// AMC says no rate; CMU recorded at this one, but for some takes at 60.
inline constexpr double kAcclaimRateHz = 120.0;

struct AcclaimOptions {
  std::optional<double> metresPerUnit;  ///< Empty: inches over the skeleton's `length`, as CMU's.
  std::optional<double> rateHz;         ///< Empty: kAcclaimRateHz, with a note.
};

/// Joints are called as the bones, the root is "root". Safe on hostile input. Errors name file and
/// line: `asfName` or `amcName`.
[[nodiscard]] Result<Clip> parseAcclaim(std::string_view asf, const std::string& asfName,
                                        std::string_view amc, const std::string& amcName,
                                        const AcclaimOptions& options = {});

/// The skeleton beside a motion: walk.asf for walk.amc, 01.asf for 01_02.amc, or the only one in
/// the folder. Error names `amcPath`.
[[nodiscard]] Result<std::string> skeletonBeside(const std::string& amcPath);

}  // namespace foretouch
