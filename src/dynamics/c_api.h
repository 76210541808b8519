/* The exact torque-free motion for C, and for every language that calls C: torque_free.h says what it computes.
 *
 * Frames: W world, B body (principal axes). Quaternions are w, x, y, z. Units: any consistent set; radians.
 * Functions return bookspin_ok, bookspin_invalid_argument (and bookspin_error says what is wrong) or
 * bookspin_out_of_memory; output is written only with bookspin_ok. A motion never changes: threads may share it.
 */
#ifndef BOOKSPIN_C_API_H
#define BOOKSPIN_C_API_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct bookspin_motion bookspin_motion;

enum { bookspin_ok = 0, bookspin_invalid_argument = 1, bookspin_out_of_memory = 2 };

/* A body of principal moments I_B, from orientation q_WB and angular momentum L_W at t = 0. */
int bookspin_create(const double I_B[3], const double q_WB[4], const double L_W[3], bookspin_motion** motion);

/* A book, eight particles of mass 1 at the corners of a box of these edges, from W = B and omega_W at t = 0. */
int bookspin_create_book(const double size[3], const double omega_W[3], bookspin_motion** motion);

/* At each of count times: q_WB (4 numbers a time), L_B and omega_B (3 each). NULL for what is not wanted. */
int bookspin_at(const bookspin_motion* motion, size_t count, const double* t, double* q_WB, double* L_B,
                double* omega_B);

void bookspin_destroy(bookspin_motion* motion); /* NULL is allowed */

/* What was wrong with this thread's last call that failed; valid until its next failure. */
const char* bookspin_error(void);

#ifdef __cplusplus
}
#endif

#endif
