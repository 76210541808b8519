"""exact.py [LIBRARY]: the exact motion from Python, and how far numerical integration is from it.

Exit code 1 when they differ by more than the integration's own error.
"""
import ctypes
import ctypes.util
import sys

library = ctypes.CDLL(sys.argv[1] if sys.argv[1:] else ctypes.util.find_library("bookspin_dynamics"))
library.bookspin_error.restype = ctypes.c_char_p
vector = lambda numbers: (ctypes.c_double * len(numbers))(*numbers)

I_B, q0, L0 = [1.0, 2.0, 3.0], [1.0, 0.0, 0.0, 0.0], [0.02, 2.0, -0.03]  # about the middle axis, nearly
t_end = 25.0
motion = ctypes.c_void_p()
if library.bookspin_create(vector(I_B), vector(q0), vector(L0), ctypes.byref(motion)):
    sys.exit(library.bookspin_error().decode())
q, L = vector([0.0] * 4), vector([0.0] * 3)
if library.bookspin_at(motion, ctypes.c_size_t(1), vector([t_end]), q, L, None):
    sys.exit(library.bookspin_error().decode())
library.bookspin_destroy(motion)


def rates(t, y):  # of (w, x, y, z, L_B): q' = q omega / 2, L' = L x omega
    w, x, y, z, L1, L2, L3 = y
    a, b, c = L1 / I_B[0], L2 / I_B[1], L3 / I_B[2]
    return [-(x * a + y * b + z * c) / 2, (w * a + y * c - z * b) / 2, (w * b + z * a - x * c) / 2,
            (w * c + x * b - y * a) / 2, L2 * c - L3 * b, L3 * a - L1 * c, L1 * b - L2 * a]


def rk4(y, steps):
    add = lambda y, k, h: [a + h * b for a, b in zip(y, k)]
    h = t_end / steps
    for _ in range(steps):
        k1 = rates(0, y)
        k2 = rates(0, add(y, k1, h / 2))
        k3 = rates(0, add(y, k2, h / 2))
        k4 = rates(0, add(y, k3, h))
        y = [a + h / 6 * (p + 2 * q + 2 * r + s) for a, p, q, r, s in zip(y, k1, k2, k3, k4)]
    return y


try:
    from scipy.integrate import solve_ivp
    name, bound = "scipy's DOP853", 1e-10  # measured: 3.6e-12
    found = list(solve_ivp(rates, [0, t_end], q0 + L0, "DOP853", rtol=1e-13, atol=1e-15).y[:, -1])
except ImportError:
    name, bound = "RK4", 1e-9  # measured: 6.0e-11
    found = rk4(q0 + L0, 40000)
error = max(abs(a - b) for a, b in zip(found, list(q) + list(L)))
print(f"exact at t = {t_end:g}: q = {list(q)}, L_B = {list(L)}\n{name} differs by {error:.1e}")
sys.exit(1 if error > bound else 0)
