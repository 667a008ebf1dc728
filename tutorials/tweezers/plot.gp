# Diameters over force, with the experiment's error bars.
set terminal pngcairo size 900,600 font ",12"
set output "postProcessing/tweezers.png"
set datafile separator ","
set datafile columnheaders
set xlabel "force [pN]"
set ylabel "diameter [um]"
set xrange [-5:205]
set yrange [2:19]
set key top left
reference = "reference/mills2004.csv"
result = "postProcessing/relax/rbc.csv"
plot reference using 1:2:3:4 with yerrorbars pt 7 lc rgb "#1f77b4" title "axial, Mills et al. 2004", \
     reference using 1:5:6:7 with yerrorbars pt 5 lc rgb "#d62728" title "transverse, Mills et al. 2004", \
     result using ($2*1e12):($3*1e6) with lines lw 2 lc rgb "#1f77b4" title "axial", \
     result using ($2*1e12):($4*1e6) with lines lw 2 lc rgb "#d62728" title "transverse"
