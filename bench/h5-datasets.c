/* What HDF5 itself takes for the datasets of a stream: `h5-datasets write|read FILE N` writes or reads seven contiguous datasets of N doubles, from and to
 * memory that has been touched, unchecked, and prints the processor time of it. For bench/sh5.sh. SPDX-License-Identifier: GPL-3.0-or-later */
#include <hdf5.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { columns = 7 };

static double processor(void)
{
	struct timespec t;
	clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

int main(int argc, char **argv)
{
	if (argc != 4)
		return 2;
	const hsize_t n = strtoull(argv[3], NULL, 10);
	const int writes = !strcmp(argv[1], "write");
	double *data = malloc(n * columns * sizeof *data);
	if (!data)
		return 1;
	for (hsize_t i = 0; i < n * columns; i++)
		data[i] = (double)i;
	const double began = processor();
	hid_t file = writes ? H5Fcreate(argv[2], H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT) : H5Fopen(argv[2], H5F_ACC_RDONLY, H5P_DEFAULT);
	herr_t status = file < 0 ? -1 : 0;
	for (int c = 0; c < columns && status >= 0; c++) {
		char name[8];
		snprintf(name, sizeof name, "c%d", c);
		hid_t space = H5Screate_simple(1, &n, NULL);
		hid_t set = writes ? H5Dcreate(file, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT) : H5Dopen(file, name, H5P_DEFAULT);
		status = writes ? H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, data + c * n)
				: H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, data + c * n);
		H5Dclose(set), H5Sclose(space);
	}
	if (file >= 0 && H5Fclose(file) < 0)
		status = -1;
	printf("%.6f\n", processor() - began);
	free(data);
	return status < 0;
}
