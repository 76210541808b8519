/* A scene that moves while one looks, for the course page: the C interface of the WebAssembly module.
 *
 * By the code that films are made by (scene/book_run.h), a few frames at a time; the page draws and plots what lies in
 * memory here. Scenes come as numbers, those of scene/scene_json.h; words are indices into their tables (live_word).
 * There are no exceptions: what would throw calls the import bookspin.fail(text, size) and traps, and the instance is of
 * no further use.
 */
#ifndef BOOKSPIN_LIVE_H
#define BOOKSPIN_LIVE_H

#ifdef __cplusplus
extern "C" {
#endif

typedef struct live live; /* NOLINT(modernize-use-using): this is C, too */

/* numbers: frames, time_per_frame, substeps, seed; then of each book method, integrator, size (3 numbers),
 * moments (3), orientation (w, x, y, z; zeros: none), angular_velocity (3), jiggle, normalize_every, damping, stiffness,
 * particle_mass, position (3), ghost (0 or 1), show (bit i: overlay i). The motion is then at frame 0. */
live* live_open(const double* numbers, int books);
void live_close(live*);
int live_advance(live*, int frames); /* at most so many more; how many there are now */

/* live_doubles() of them a frame, frame after frame: corners (8 times x, y, z), q_WB and the exact book's (x, y, z, w),
 * L_W, omega_W, then the quantities in the order of their table. Valid as long as the scene is open. */
const double* live_track(const live*, int book);
int live_doubles(void);
int live_exploded(const live*, int book); /* the first frame so far in which it has; -1: none */

/* The book's mesh, coarse (1) or fine (4), until the next call: 14 addresses and counts of numbers. Vertices (9 floats
 * each: position, normal, texture, shade), borders (11: position, along, across, inwards), then of each part, in the order
 * of drawing, its indices (16 bits). */
const void* const* live_mesh(int fineness);

/* The next smaller picture of one of 4 bytes a pixel, until the next call. */
const unsigned char* live_halved(const unsigned char* rgba, int width, int height);

/* What a frame shows, seen from the direction `from`, `zoom` times as large as it would just fit: floats, until the next
 * call. Item after item: its kind and how many floats follow.
 *   0 solid book, 1 ghost   brightness, 1 unbent, 1 keeps orientation, corners_C (24), clip_from_camera (16), half_frame (2)
 *   2 arrow                 clip_from_world (16), R_CW (9), vertices of 10 floats
 *   3 lines, 4 translucent  vertices of 8 floats
 *  -1 the end */
const float* live_picture(live*, int frame, const double from[3], double zoom, int width, int height);

enum { live_methods, live_integrators, live_overlays, live_quantities, live_symbols, live_titles, live_units };
const char* live_word(int table, int row); /* NULL behind the last row */
int live_takes(int method, int damped, int integrator);

/* Of a quantity's chart: what it is to be multiplied by, and what the axis holds whatever the data: low, high, most. */
double live_axis(int quantity, int which);

#ifdef __cplusplus
}
#endif

#endif
