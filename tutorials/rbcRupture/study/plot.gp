# Critical capillary number over the spacing, and what each run of the bisection did. Writes runs/criticalShearRate.png.
set terminal pngcairo size 1100,420 font ",11"
set output 'runs/criticalShearRate.png'
set datafile separator comma
set datafile columnheaders
set multiplot layout 1,2
set xlabel 'particle spacing [um]'; set ylabel 'Ca of the first break'
set yrange [0:*]; set xrange [0:*]; set offsets 0, graph 0.1, graph 0.3, 0; unset key
plot 'runs/summary.csv' using 'spacing_um':'Ca_critical':'Ca_whole':'Ca_breaks' with yerrorbars pt 7 lw 2
set xlabel 'Ca'; set ylabel 'strain of the first break'; set xrange [*:*]; set offsets graph 0.05, graph 0.15, graph 0.1, 0
set key top right
spacings = system("tail -n +2 runs/summary.csv | cut -d, -f1")
plot for [dx in spacings] 'runs/runs.csv' using 'Ca':(stringcolumn('spacing_um') eq dx && column('broke') == 1 ? column('strain') : NaN) with points pt 7 title dx.' um', \
    for [dx in spacings] 'runs/runs.csv' using 'Ca':(stringcolumn('spacing_um') eq dx && column('broke') == 0 ? column('strain') : NaN) with points pt 6 lc rgb 'grey' \
    title (dx eq word(spacings, 1) ? 'whole' : '')
unset multiplot
