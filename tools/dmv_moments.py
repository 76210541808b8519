#!/usr/bin/env python3
"""Prints the series of src/dynamics/rigid_steps.cpp that make discrete Moser-Veselov order 6 and 10.

With  e  the vector of the exact motion's rotation over one step,  F = (1, e) / sqrt(1 + e^2),  the step is exact if its
moments M solve

    e_1 M_1 + (M_3 - M_2) e_2 e_3 = (1 + e^2) h L_1 / 2   and cyclically,

which is linear in M. Then  1 / M_j = s / I_j + d:  s and d are constants of the motion, power series in h^2 whose
coefficients are polynomials in  C = h^2 sum L_j^2 / 2,  H = h^2 sum L_j^2 / (2 I_j)  and the elementary symmetric
functions e1, e2, e3 of the 1 / I_j  (Hairer & Vilmart, J. Phys. A 39 (2006) 13225). Here e comes from the motion's
Taylor series and the coefficients from as many motions as there are unknowns, in rational numbers; a few motions more
must agree.

    dmv_moments.py            print the expressions, a line each
    dmv_moments.py FILE.cpp   exit 1 unless they all stand there, whatever the white space
"""

import re
import sys
from fractions import Fraction
from itertools import count, product

ORDERS = 4  # h^2, h^4, h^6, h^8
TERMS = 2 * ORDERS + 1


def times(p, q):
    return [sum(p[k] * q[n - k] for k in range(n + 1)) for n in range(len(p))]


def over(p, q):
    quotient = []
    for n in range(len(p)):
        quotient.append((p[n] - sum(quotient[k] * q[n - k] for k in range(n))) / q[0])
    return quotient


def rotation_over_h(L, a):
    """Series in h of e / h, from L' = L x a L and q' = q (0, a L) / 2."""
    L = [[x] for x in L]
    q = [[Fraction(x)] for x in (1, 0, 0, 0)]
    for n in range(TERMS):
        at_n = lambda f, g: sum(f[k] * g[n - k] for k in range(n + 1))
        w = [[a[i] * x for x in L[i]] for i in range(3)]
        L_next = [at_n(L[(i + 1) % 3], w[(i + 2) % 3]) - at_n(L[(i + 2) % 3], w[(i + 1) % 3]) for i in range(3)]
        q_next = [-sum(at_n(q[1 + i], w[i]) for i in range(3))]
        q_next += [at_n(q[0], w[i]) + at_n(q[1 + (i + 1) % 3], w[(i + 2) % 3]) -
                   at_n(q[1 + (i + 2) % 3], w[(i + 1) % 3]) for i in range(3)]
        for series, term in zip(L, L_next):
            series.append(term / (n + 1))
        for series, term in zip(q, q_next):
            series.append(term / (2 * (n + 1)))
    return [over(q[i][1:], q[0][:TERMS]) for i in (1, 2, 3)]


def step_moments(L, a):
    """Series in h of 1 / M_j. Each round of the equation, solved for its first term, is right to one order more."""
    e = rotation_over_h(L, a)
    one_and_e2 = [Fraction(1)] + [Fraction(0)] * (TERMS - 1)
    for x in e:
        one_and_e2 = [p + q for p, q in zip(one_and_e2, [0, 0] + times(x, x))]
    M = [[1 / x] + [Fraction(0)] * (TERMS - 1) for x in a]
    for _ in range(TERMS):
        coupling = [[0] + times([p - q for p, q in zip(M[i - 1], M[i - 2])], times(e[i - 2], e[i - 1]))
                    for i in range(3)]
        M = [over([x * L[i] / 2 - y for x, y in zip(one_and_e2, coupling[i])], e[i]) for i in range(3)]
    one = [Fraction(1)] + [Fraction(0)] * (TERMS - 1)
    return [over(one, x) for x in M]


def monomials(weight):
    """(n1, n2, n3) of e1^n1 e2^n2 e3^n3 with n1 + 2 n2 + 3 n3 = weight; those of most factors first."""
    found = [(weight - 2 * n2 - 3 * n3, n2, n3) for n2, n3 in product(range(weight // 2 + 1), range(weight // 3 + 1))
             if weight >= 2 * n2 + 3 * n3]
    return sorted(found, key=lambda n: (-sum(n), n[2]))


def solve(rows):
    """x with row[:-1] . x = row[-1] for all rows, of which there are more than unknowns."""
    unknowns = len(rows[0]) - 1
    rows = [row[:] for row in rows]
    for column in range(unknowns):
        pivot = next(i for i in range(column, len(rows)) if rows[i][column] != 0)
        rows[column], rows[pivot] = rows[pivot], rows[column]
        rows[column] = [x / rows[column][column] for x in rows[column]]
        for i, row in enumerate(rows):
            if i != column and row[column] != 0:
                rows[i] = [x - row[column] * y for x, y in zip(row, rows[column])]
    assert all(row[-1] == 0 for row in rows[unknowns:]), "no polynomial of this form"
    return [row[-1] for row in rows[:unknowns]]


def motions():
    """L, a and the series of s and d, for one motion after another."""
    for n in count():
        L = [Fraction(1 + n * n % 5), Fraction(2 + n % 7), Fraction(1 + n % 3)]
        a = [Fraction(1 + n % 4), Fraction(5 + n * 3 % 11), Fraction(-1 - n * 5 % 13)]
        r = step_moments(L, a)
        s = [(x - y) / (a[0] - a[1]) for x, y in zip(r[0], r[1])]
        d = [x - a[0] * y for x, y in zip(r[0], s)]
        assert r[2] == [a[2] * y + x for x, y in zip(d, s)]
        yield L, a, s, d


def unknowns(order, extra):
    return [(j, n) for j in range(order + 1) for n in monomials(2 * order - j + extra)]


def coefficients(order, extra, samples):
    rows = []
    for L, a, *series in samples[:len(unknowns(order, extra)) + 3]:
        C = sum(x * x for x in L) / 2
        H = sum(x * x * y for x, y in zip(L, a)) / 2
        e1, e2, e3 = sum(a), a[0] * a[1] + a[1] * a[2] + a[2] * a[0], a[0] * a[1] * a[2]
        rows.append([C**(order - j) * H**j * e1**n[0] * e2**n[1] * e3**n[2] for j, n in unknowns(order, extra)] +
                    [series[extra][2 * order]])
    return dict(zip(unknowns(order, extra), solve(rows)))


def term(names, coefficient):
    text = "*".join(names)
    if abs(coefficient.numerator) != 1:
        text += f"*{abs(coefficient.numerator)}"
    return text if coefficient.denominator == 1 else f"{text}/{coefficient.denominator}"


def joined(signed):
    text = "".join(("-" if negative else "+") + part for negative, part in signed)
    return text.removeprefix("+")


def expression(order, extra, samples):
    found = coefficients(order, extra, samples)
    parts = []
    for j in range(order + 1):
        prefix = ["H"] * j + ["C"] * (order - j)
        inner = [(n, found[j, n]) for n in monomials(2 * order - j + extra) if found[j, n] != 0]
        names = lambda n: ["e1"] * n[0] + ["e2"] * n[1] + ["e3"] * n[2]
        if len(inner) == 1:
            parts.append((inner[0][1] < 0, term(prefix + names(inner[0][0]), inner[0][1])))
            continue
        all_negative = all(x < 0 for _, x in inner)
        sum_of = joined([(x < 0 and not all_negative, term(names(n), x)) for n, x in inner])
        parts.append((all_negative, f"{'*'.join(prefix)}*({sum_of})"))
    return joined(parts)


def main():
    motion = motions()
    samples = [next(motion) for _ in range(len(unknowns(ORDERS, 1)) + 3)]
    expressions = [expression(order, extra, samples) for order in range(1, ORDERS + 1) for extra in (0, 1)]
    if len(sys.argv) == 1:
        print("\n".join(expressions))
        return 0
    with open(sys.argv[1], encoding="utf-8") as file:
        source = re.sub(r"\s", "", file.read())
    missing = [x for x in expressions if x + ";" not in source]
    for x in missing:
        print(f"{sys.argv[1]}: not there: {x}")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
