// The book that a method of a script names, whatever its type: the one place where the method is chosen.
#pragma once

#include <variant>

#include "dynamics/integrators.h"
#include "dynamics/rigid_book.h"
#include "dynamics/rigid_motion.h"
#include "dynamics/spring_book.h"
#include "scene/scene.h"

namespace bookspin {

using AnyBook = std::variant<SpringBook, MatrixBook, QuaternionBook, FreeBook, ExactBook>;

// Whether the method may be stepped by the integrator; the exact motion takes no steps.
[[nodiscard]] bool takes(Method method, bool damped, const IntegratorInfo& integrator);

// Throws std::invalid_argument when the method does not take the integrator.
[[nodiscard]] AnyBook make_book(Method method, const BookOptions& options);

}  // namespace bookspin
