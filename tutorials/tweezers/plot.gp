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
plot reference using 'force_pN':'axial_um':'axialLow_um':'axialHigh_um' with yerrorbars pt 7 lc rgb "#1f77b4" title "axial, Mills et al. 2004", \
     reference using 'force_pN':'transverse_um':'transverseLow_um':'transverseHigh_um' with yerrorbars pt 5 lc rgb "#d62728" title "transverse, Mills et al. 2004", \
     result using (column('force_N')*1e12):(column('axialDiameter_m')*1e6) with lines lw 2 lc rgb "#1f77b4" title "axial", \
     result using (column('force_N')*1e12):(column('transverseDiameter_m')*1e6) with lines lw 2 lc rgb "#d62728" title "transverse"
