// The instability of the spin about x: how fast a tilt grows, and when the book turns over.
//
// Theory: a tilt of the angular momentum against the body's x axis grows as e^(sigma t), sigma = omega sqrt((I2 -
// I1)(I3 - I2) / (I1 I3)), and the book has turned half over at the first zero of L_x in the body frame
// (TorqueFree::first_flip), about ln(4 / kick) / sigma. Measured: the tilt (of R^T L, R the best-fit orientation)
// sampled each 0.1; its rate by least squares of ln(tilt) between two tilts; the flip where the tilt first passes 90
// degrees. All methods at the paper's step h = 0.1 / 6, spin 0.11482.
#pragma once

#include "report/measure.h"
#include "report/table.h"

namespace bookspin {

[[nodiscard]] double theoretical_growth_rate();

[[nodiscard]] Table growth_rates(const Effort& effort);

// One row a kick (0: none, from rounding alone), one column a method; "never": not within 3000 units of time.
[[nodiscard]] Table flip_times(const Effort& effort);

}  // namespace bookspin
