# Way of one capsule past the other: postProcessing/path.png
set terminal pngcairo size 900,420 font ",11"
set output 'postProcessing/path.png'
set datafile separator comma
set datafile columnheaders
set xlabel 'distance along the flow [radii]'
set ylabel 'distance along the gradient [radii]'
set yrange [0:]
set grid
plot 'postProcessing/path.csv' using 'along':'across' with linespoints pt 7 ps 0.4 lw 2 notitle
