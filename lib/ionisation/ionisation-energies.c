/* Ionisation energies [eV], of the neutral atom first. Source: Kramida, Ralchenko, Reader and NIST ASD Team, NIST Atomic Spectra Database (ionisation
 * energies), by way of the Python package mendeleev 1.3.0. The subshell that gives the next electron is that of the ground state of a highly charged ion
 * (1s 2s 2p 3s 3p 3d 4s 4p 4d 5s 5p), which NIST has for every stage of these elements. SPDX-License-Identifier: GPL-3.0-or-later */
#include <stddef.h>
#include <string.h>

#include "ionisation/ionisation-energies.h"

static const double h[] = {13.598434599702};
static const double he[] = {24.587389011, 54.4177655282};
static const double li[] = {5.391714996, 75.640097, 122.45435913};
static const double be[] = {9.322699, 18.21115, 153.896205, 217.71858459};
static const double b[] = {8.298019, 25.15483, 37.93059, 259.374379, 340.2260225};
static const double c[] = {11.260288, 24.383143, 47.88778, 64.49352, 392.09056, 489.99320779};
static const double n[] = {14.53413, 29.60125, 47.4453, 77.4735, 97.8901, 552.06741, 667.0461377};
static const double o[] = {13.618055, 35.12112, 54.93554, 77.4135, 113.899, 138.1189, 739.32697, 871.4099138};
static const double f[] = {17.42282, 34.97081, 62.70798, 87.175, 114.249, 157.16311, 185.1868, 953.8983, 1103.1175302};
static const double ne[] = {21.564541, 40.96297, 63.4233, 97.19, 126.247, 157.934, 207.271, 239.097, 1195.8082, 1362.199256};
static const double na[] = {5.13907696, 47.28636, 71.62, 98.936, 138.404, 172.23, 208.504, 264.192, 299.856, 1465.0992, 1648.702285};
static const double mg[] = {7.646236, 15.035271, 80.1436, 109.2654, 141.33, 186.76, 225.02, 265.924, 327.99, 367.489, 1761.8049, 1962.663889};
static const double al[] = {5.985769, 18.82855, 28.447642, 119.9924, 153.8252, 190.49, 241.76, 284.64, 330.21, 398.65, 442.005, 2085.97693, 2304.140359};
static const double si[] = {8.15168, 16.34585, 33.493, 45.14179, 166.767, 205.279, 246.57, 303.59, 351.28, 401.38, 476.273, 523.415, 2437.65805,
	2673.177958};
static const double p[] = {10.486686, 19.76949, 30.20264, 51.44387, 65.02511, 220.43, 263.57, 309.6, 372.31, 424.4, 479.44, 560.62, 611.741, 2816.90868,
	3069.842145};
static const double s[] = {10.36001, 23.33788, 34.86, 47.222, 72.5945, 88.0529, 280.954, 328.794, 379.84, 447.7, 504.55, 564.41, 651.96, 706.994,
	3223.78057, 3494.188518};
static const double cl[] = {12.967633, 23.81364, 39.8, 53.24, 67.68, 96.94, 114.2013, 348.306, 400.851, 456.7, 530, 591.58, 656.3, 750.23, 809.198,
	3658.34366, 3946.29179};
static const double ar[] = {15.7596119, 27.62967, 40.735, 59.58, 74.84, 91.29, 124.41, 143.4567, 422.6, 479.76, 540.4, 619, 685.5, 755.13, 855.5, 918.375,
	4120.66559, 4426.22407};
static const double kr[] = {13.9996055, 24.35984, 35.838, 50.85, 64.69, 78.49, 109.13, 125.802, 233, 268, 308, 350, 391, 446, 492, 540, 591, 640, 785.316,
	831.6, 882.8, 945, 999, 1042, 1155, 1205.23, 2928.9, 3072, 3228, 3380, 3584, 3752, 3971, 4109.083, 17296.424, 17936.2405};
static const double xe[] = {12.1298437, 20.975, 31.05, 42.2, 54.1, 66.703, 91.6, 105.9778, 179.84, 202, 229.02, 255, 281, 314, 343, 374, 404, 434, 549,
	582, 616, 650, 700, 736, 818, 857, 1493, 1571, 1653, 1742, 1826, 1919, 2023, 2113, 2209, 2300, 2556, 2637, 2726, 2811, 2975, 3068, 3243, 3333.8,
	7660, 7889, 8144, 8382, 8971, 9243, 9581, 9810.37, 40271.73, 41299.892};

static const struct pm_element elements[] = {
	{"H", 1, h}, {"He", 2, he}, {"Li", 3, li}, {"Be", 4, be}, {"B", 5, b}, {"C", 6, c}, {"N", 7, n}, {"O", 8, o}, {"F", 9, f}, {"Ne", 10, ne},
	{"Na", 11, na}, {"Mg", 12, mg}, {"Al", 13, al}, {"Si", 14, si}, {"P", 15, p}, {"S", 16, s}, {"Cl", 17, cl}, {"Ar", 18, ar}, {"Kr", 36, kr},
	{"Xe", 54, xe},
};

const struct pm_element *pm_element_find(const char *symbol)
{
	for (size_t k = 0; k < sizeof elements / sizeof *elements; k++)
		if (!strcmp(symbol, elements[k].symbol))
			return &elements[k];
	return NULL;
}

const struct pm_element *pm_element_at(size_t k) { return k < sizeof elements / sizeof *elements ? &elements[k] : NULL; }

int pm_element_l(int electrons)
{
	static const struct { int electrons, l; } filled[] = {{2, 0}, {4, 0}, {10, 1}, {12, 0}, {18, 1}, {28, 2}, {30, 0}, {36, 1}, {46, 2}, {48, 0}, {54, 1}};
	int k = 0;
	while (electrons > filled[k].electrons)
		k++;
	return filled[k].l;
}
