# Pressure drop and flow rate over time, beside Womersley's solution. Writes postProcessing/womersley.png.
set terminal pngcairo size 900,500 font ",11"
set output 'postProcessing/womersley.png'
set datafile separator comma
set datafile columnheaders
set key top right
set xlabel 'time, s'; set ylabel 'flow rate, mL/s'; set y2label 'pressure drop, Pa'
set ytics nomirror; set y2tics
plot 'postProcessing/womersley.csv' using 'time_s':'drive' axes x1y2 with lines lc rgb '#999999' dt 2 title 'pressure drop', \
     '' using 'time_s':'exact_mL_s' with lines lc rgb '#d62728' lw 2 title 'Womersley', \
     '' using 'time_s':'flowRate_mL_s' with points pt 6 ps 0.7 lc rgb '#1f77b4' title 'computed'
