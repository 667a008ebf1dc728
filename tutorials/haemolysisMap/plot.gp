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
# A column of powerLaws.csv is A, alpha, beta of a law.
laws = "Giersiepen_1990 Song_2003 Zhang_2011 Ding_2015_(human) Ding_2015_(porcine) Ding_2015_(bovine)"
A = "3.62e-5 1.8e-6 1.228e-5 3.458e-6 6.701e-4 9.772e-5"
alpha = "2.416 1.991 1.9918 2.0639 1.0981 1.4445"
name(i) = system(sprintf("echo '%s' | tr _ ' '", word(laws, i)))
one = "< awk -F, 'NR == 2 || ($2 == 1 && $4 == 1)' runs/map.csv"
many = "< awk -F, 'NR == 2 || ($2 > 1 && $4 == 1)' runs/map.csv"
plot for [i=1:5] [25:1500] word(A, i) * x ** word(alpha, i) with lines lw 1 dt i lc rgb "gray50" title name(i), \
     [25:1500] word(A, 6) * x ** word(alpha, 6) with lines lw 3 dt 1 lc rgb "gray80" title name(6), \
     one using "stress_Pa":"index":"standardError" with errorbars pt 7 lc rgb "#b2182b" title "one cell", \
     many using "stress_Pa":"index":"standardError" with errorbars pt 9 ps 1.5 lc rgb "#2166ac" title "several cells"
set xlabel "exposure [s]"
set ylabel "index of haemolysis [%]"
set xrange [1e-3:10]
set yrange [1e-5:100]
cases = system("awk -F, '!/^#/ && $1 != \"case\" && $5 > 0 {print $1}' runs/map.csv | uniq")
plot for [c in cases] "< awk -F, 'NR == 2 || $1 == \"" . c . "\"' runs/map.csv" using "exposure_s":"index" with lines lw 2 title c noenhanced
unset multiplot
