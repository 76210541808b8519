/* c_api_test T...: each error says what is wrong, and then w x y z at each time T. */
#include "dynamics/c_api.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void require(int holds, const char* what) {
  if (holds) return;
  fprintf(stderr, "does not hold: %s (last error: %s)\n", what, bookspin_error());
  exit(1);
}

int main(int argc, char** argv) {
  const double size[3] = {1.878, 2.9085, 0.5};
  const double omega_W[3] = {0.11482, 1e-4, -2e-4};
  const double I_B[3] = {17.4187445, 7.553768, 23.9725125}; /* of this size */
  const double flat[3] = {1, 0, 1};
  const double no_rotation[4] = {0, 0, 0, 0};
  const double bad_time = NAN;
  double t[16], q_WB[4 * 16], L_B[3 * 16], omega_B[3 * 16];
  bookspin_motion* motion = NULL;
  int i, d;

  require(bookspin_create_book(flat, omega_W, &motion) == bookspin_invalid_argument, "an edge of 0 is refused");
  require(strstr(bookspin_error(), "edge") != NULL, "the error names the edge");
  require(bookspin_create(size, no_rotation, omega_W, &motion) == bookspin_invalid_argument, "q = 0 is refused");
  require(bookspin_create(size, NULL, omega_W, &motion) == bookspin_invalid_argument, "NULL is refused");
  require(motion == NULL, "no motion comes of an error");
  bookspin_destroy(NULL);

  require(bookspin_create_book(size, omega_W, &motion) == bookspin_ok, "a book is created");
  require(bookspin_at(motion, 1, &bad_time, q_WB, NULL, NULL) == bookspin_invalid_argument, "t = NaN is refused");
  require(bookspin_at(motion, 0, NULL, NULL, NULL, NULL) == bookspin_ok, "no times are allowed");
  require(argc - 1 <= 16, "at most 16 times");
  for (i = 1; i < argc; ++i) t[i - 1] = strtod(argv[i], NULL);
  require(bookspin_at(motion, (size_t)(argc - 1), t, q_WB, L_B, omega_B) == bookspin_ok, "the motion at all times");
  for (i = 0; i < argc - 1; ++i) {
    const double* q = q_WB + 4 * i;
    for (d = 0; d < 3; ++d) { /* measured: 2.3e-16 at most */
      require(fabs(omega_B[3 * i + d] * I_B[d] / L_B[3 * i + d] - 1) < 1e-15, "omega_B = L_B / I_B");
    }
    printf("%.17g %.17g %.17g %.17g\n", q[0], q[1], q[2], q[3]);
  }
  bookspin_destroy(motion);
  return 0;
}
