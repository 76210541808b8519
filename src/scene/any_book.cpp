#include "scene/any_book.h"

#include <stdexcept>
#include <string>

namespace bookspin {

bool takes(Method method, bool damped, const IntegratorInfo& integrator) {
  switch (method) {
    case Method::springs:
      return integrator.spring_steps != nullptr && (integrator.damped || !damped);
    case Method::matrix:
      return integrator.matrix;
    case Method::quaternion:
      return integrator.quaternion;
    case Method::exact:
      break;
  }
  return false;
}

AnyBook make_book(Method method, const BookOptions& options) {
  if (method == Method::exact) return ExactBook(options);
  const IntegratorInfo& integrator = info_of(options.integrator);
  if (!takes(method, options.damping > 0.0, integrator)) {
    throw std::invalid_argument(std::string(name_of(method)).append(" does not take ").append(integrator.name));
  }
  if (method == Method::springs) return SpringBook(options);
  if (method == Method::matrix) return MatrixBook(options);
  if (integrator.rigid_steps == nullptr) return QuaternionBook(options);
  return FreeBook(options);
}

}  // namespace bookspin
