// "Did you mean ...?"
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace crt::lang {

/// The candidate that a typist most likely meant by `word`; empty if none is near. Ties go to the
/// first.
std::string_view nearest(std::string_view word, const std::vector<std::string_view>& candidates);

/// "; did you mean 'radius'?", or nothing.
std::string did_you_mean(std::string_view word, const std::vector<std::string_view>& candidates);

/// "a", "a or b", "a, b or c".
std::string enumerate(const std::vector<std::string>& items, std::string_view last_joint = "or");

}  // namespace crt::lang
