# Deformation index over strain, one line for each case.  gnuplot -c plot.gp CASE...   Writes runs/D12.png.
cases = ''
do for [i=1:ARGC] { cases = cases . ' ' . value('ARG' . i) }
file(case) = system('ls ' . case . '/postProcessing/deformation/*.csv')
name(case) = system('basename ' . case)
set terminal pngcairo size 1200,500 font ",11"
set output 'runs/D12.png'
set datafile separator comma
set datafile columnheaders
set xlabel 'strain'
set multiplot layout 1,2
set key below
set ylabel 'D12 by extents'
plot for [c in cases] file(c) using 'strain':'D12_extent' with lines lw 2 title name(c)
set ylabel 'D12 by inertia'
plot for [c in cases] file(c) using 'strain':'D12_inertia' with lines lw 2 title name(c)
unset multiplot
