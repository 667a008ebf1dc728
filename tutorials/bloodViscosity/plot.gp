# Relative viscosity with its standard error over shear rate, a line for each haematocrit; dashed: high-shear limit of measured blood,
# 1 + 2.07 H + 3.72 H^2 (Casson viscosity over that of plasma at 37 C; Apostolidis and Beris 2014, J. Rheol. 58, 607).
set terminal pngcairo size 900,600 font "sans,12"
set output "runs/viscosity.png"
set datafile separator comma
set datafile columnheaders
set xlabel "shear rate [1/s]"
set ylabel "viscosity / viscosity of plasma"
set logscale x
set xrange [*<0.8:1250<*]
set yrange [1:]
set key top right
haematocrits = system("grep -v '^[#h]' runs/viscosity.csv | cut -d, -f1 | sort -u")
limit(h) = 1 + 2.0703*h + 3.7222*h**2
n = words(haematocrits)
plot for [i=1:n] "runs/viscosity.csv" using "shearRate_1_s":(abs(column("haematocrit") - word(haematocrits, i)) < 1e-6 ? column("relativeViscosity") : NaN):"standardError" \
         with errorlines lw 2 pt 7 lc i title "haematocrit " . word(haematocrits, i), \
     for [i=1:n] limit(word(haematocrits, i) + 0) with lines dashtype 2 lc i notitle
