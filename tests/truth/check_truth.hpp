// These check that the truth is never outside of what is said about random solids. Each takes one
// solid or pair of solids, that with the number, into the account.
#pragma once

#include <cstdint>

#include "truth/account.hpp"

namespace crt::truth {

/// Compares volume, area, centroid and box of a solid of a known form, in a random place, with the
/// closed forms.
void check_form(std::uint64_t number, Account& account);

/// Compares what is said of a tree of all primitives with what is said of it in another place, of
/// its parts and of pieces of it, with chords of rays, and with points known to be inside.
void check_tree(std::uint64_t number, Account& account);

/// Compares which points are in a tree with the oracle: 100 points anywhere, on the grid and next
/// to the surface.
void check_points(std::uint64_t number, Account& account);

/// Compares the distance of two solids with closed forms, or with the distances of their points.
void check_pair(std::uint64_t number, Account& account);

}  // namespace crt::truth
