# Suction over the length of the tongue: the red cell beside Evans' relation, the white cell beside Laplace's law.
set terminal pngcairo size 1200,520 font ",12"
set output "runs/aspiration.png"
set datafile separator ","
set datafile columnheaders
set multiplot layout 1,2
set xlabel "L/R"
set key bottom right
set ylabel "P R/Gs"
set xrange [0:2.5]
set yrange [0:5]
plot (x > 0.99 ? 2*x-1+log(2*x) : NaN) with lines lw 2 lc rgb "#1f77b4" title "2 L/R - 1 + ln(2 L/R), Evans", \
     "runs/redCell/postProcessing/relax/redCell.csv" using 'lengthOverRadius':(column('suction_Pa')*1e-6/4e-6) with linespoints pt 7 lc rgb "#d62728" title "red cell"
set ylabel "P [Pa]"
set xrange [0.3:1.1]
set yrange [0:18]
# Cap tangent to the lip; tension and radius of the cell as they are about L = 0.7 R.
R = 2.0; lip = 0.5; T = 27.4; cell = 4.15
cap(x) = ((x*R-lip)**2 + (R+lip)**2 - lip**2)/(2*x*R)
plot 2*T*(1/cap(x) - 1/cell) with lines lw 2 lc rgb "#1f77b4" title "2 T (1/R_{cap} - 1/R_{cell}), Laplace", \
     "runs/whiteCell/postProcessing/relax/whiteCell.csv" using 'lengthOverRadius':'suction_Pa' with linespoints pt 7 lc rgb "#d62728" title "white cell"
unset multiplot
