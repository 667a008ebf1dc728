# Apparent viscosity, and tube and discharge haematocrit, over time.
set terminal pngcairo size 900,600 font "sans,12"
set output "postProcessing/flow.png"
set datafile separator comma
set datafile columnheaders
set xlabel "time (ms)"
set ylabel "apparent viscosity / viscosity of plasma"
set y2label "haematocrit"
set ytics nomirror
set y2tics
set key right bottom
set yrange [1:*]
set y2range [0:*]
plot "postProcessing/flow/flowRate.csv" using (1e3 * column("time_s")):"relativeViscosity" with lines lw 2 title "apparent viscosity", \
     "" using (1e3 * column("time_s")):"haematocrit_tube" axes x1y2 with lines lw 2 title "tube haematocrit", \
     "" using (1e3 * column("time_s")):"haematocrit_discharge" axes x1y2 with lines lw 2 title "discharge haematocrit"
