# Pressure over stretch beside the law's closed formula.
set terminal pngcairo size 900,600 font ",12"
set output "postProcessing/inflation.png"
set datafile separator ","
set datafile columnheaders
set xlabel "stretch l"
set ylabel "pressure p a/Gs"
set xrange [1:1.3]
set yrange [0:1.3]
set key bottom right
plot 2*(1-x**-6)/x with lines lw 2 lc rgb "#1f77b4" title "2 (1 - l^{-6})/l", \
     "postProcessing/relax/capsule.csv" using 'stretch':(column('pressure_Pa')*4e-6/4e-6) with points pt 7 ps 1.4 lc rgb "#d62728" title "membraneRelax, neoHookean"
