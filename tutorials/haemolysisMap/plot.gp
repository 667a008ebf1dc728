# Index of haemolysis over stress after 1 s, and over time at each stress; grey: between the lowest and the highest power law.
set terminal pngcairo size 1200,520 font "sans,11"
set output "runs/map.png"
set datafile separator comma
set datafile columnheaders
set logscale xy
set format y "10^{%L}"
set style fill solid 0.25 noborder
set key bottom right
set multiplot layout 1,2
set xlabel "shear stress [Pa]"
set ylabel "index of haemolysis after 1 s [%]"
set xrange [25:1500]
set yrange [1e-4:100]
law(i, column) = system(sprintf("grep -v '^[#n]' powerLaws.csv | awk -F, 'NR == %d {print %s}'", i, column))
name(i) = law(i, "$1 \" (\" $5 \")\"")
A(i) = law(i, "$2") + 0
alpha(i) = law(i, "$3") + 0
one = "< awk -F, 'NR == 2 || ($2 == 1 && $4 == 1)' runs/map.csv"
many = "< awk -F, 'NR == 2 || ($2 > 1 && $4 == 1)' runs/map.csv"
plot for [i=1:5] [25:1500] A(i) * x ** alpha(i) with lines lw 1 dt i lc rgb "gray50" title name(i), \
     [25:1500] A(6) * x ** alpha(6) with lines lw 3 dt 1 lc rgb "gray80" title name(6), \
     one using "stress_Pa":"index":"standardError" with errorbars pt 7 lc rgb "#b2182b" title "one cell", \
     many using "stress_Pa":"index":"standardError" with errorbars pt 9 ps 1.5 lc rgb "#2166ac" title "several cells"
set xlabel "exposure [s]"
set ylabel "index of haemolysis [%]"
set xrange [1e-3:10]
set yrange [1e-5:100]
cases = system("awk -F, '!/^#/ && $1 != \"case\" && $5 > 0 {print $1}' runs/map.csv | uniq")
plot for [c in cases] "< awk -F, 'NR == 2 || $1 == \"" . c . "\"' runs/map.csv" using "exposure_s":"index" with lines lw 2 title c noenhanced
unset multiplot
