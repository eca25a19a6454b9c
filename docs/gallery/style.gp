# How the plots of columns look: the ink, the frame and the letters' size of sdraw. gnuplot docs/gallery/style.gp - <<'END' > plot.png
# SPDX-License-Identifier: GPL-3.0-or-later
set encoding utf8
set terminal pngcairo size 480,352 font "DejaVu Sans,8.5" enhanced linewidth 1.2 background "#ffffff"
set datafile separator whitespace
set border 31 linecolor "#262a33" linewidth 1
set tics out nomirror scale 0.6 textcolor "#262a33"
set xlabel textcolor "#262a33" offset 0,0.4
set ylabel textcolor "#262a33" offset 1,0
set title textcolor "#262a33" offset 0,-0.4
set key textcolor "#262a33" spacing 1.15 samplen 1.6
set lmargin 9; set rmargin 2; set bmargin 3.4; set tmargin 2.2
set style line 1 linecolor "#1f61ab" linewidth 1.7 pointtype 7 pointsize 0.6
set style line 2 linecolor "#b40426" linewidth 1.7 pointtype 5 pointsize 0.6
set style line 3 linecolor "#e08a1e" linewidth 1.7 pointtype 9 pointsize 0.7
set style line 4 linecolor "#2a8a5f" linewidth 1.7 pointtype 13 pointsize 0.8
set style line 5 linecolor "#6a4c93" linewidth 1.7 pointtype 11 pointsize 0.7
set style line 6 linecolor "#17a2b8" linewidth 1.7 pointtype 4 pointsize 0.6
set style line 7 linecolor "#262a33" linewidth 1.7 pointtype 6 pointsize 0.6
set style line 8 linecolor "#b40426" linewidth 2 dashtype 3
set style line 9 linecolor "#9aa0aa" linewidth 1.2 dashtype 2
