/* The Green's function of a blob of order 4, Gaussian times a polynomial: smooth, so its value at 0 needs no correction; the potential is that of the
 * source smoothed over sigma = 2 h (or softening/sqrt(2)), with an error O(sigma^4). Source: Hejlesen, Rasmussen, Chatelain and Walther 2013.
 * Cost: an exponential and an error function or exponential integral per node, once.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "green-parts/gauss-blob.h"

PM_GREEN_GAUSS(4, "regularised by a blob of order 4, Gaussian times a polynomial")
