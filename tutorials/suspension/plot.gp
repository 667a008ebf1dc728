# Relative viscosity over strain, by the forces on the walls and by the stress of the cells.
set terminal pngcairo size 900,600 font "sans,12"
set output "postProcessing/viscosity.png"
set datafile separator comma
set datafile columnheaders
set xlabel "strain"
set ylabel "viscosity / viscosity of plasma"
set key right bottom
set yrange [1:]
plot "postProcessing/wall/wallStress.csv" using "strain":(column("effectiveViscosity") > 0 ? column("effectiveViscosity") : NaN) with lines lw 2 title "by the walls", \
     "postProcessing/blood/suspension.csv" using "strain":"relativeViscosity" with lines lw 2 title "by the cells"
