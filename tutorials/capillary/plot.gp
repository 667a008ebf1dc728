# Position and velocity of the cell, and the flow rate, over time.
set terminal pngcairo size 900,600 font "sans,12"
set output "postProcessing/passage.png"
set datafile separator comma
set datafile columnheaders
set xlabel "time (ms)"
set ylabel "position of the cell (um)"
set y2label "flow rate (um^3/ms), velocity of the cell (um/ms, times 20)"
set ytics nomirror
set y2tics
set key center top
set y2range [0:*]
plot "postProcessing/cells/rbc.csv" using (1e3 * column("time_s")):(1e6 * column("centroid_x_m")) with lines lw 2 title "position", \
     "" using (1e3 * column("time_s")):(2e4 * column("velocity_x_m_s")) axes x1y2 with lines lw 2 title "velocity, times 20", \
     "postProcessing/flow/flowRate.csv" using (1e3 * column("time_s")):(1e15 * column("flowRate_m3_s")) axes x1y2 with lines lw 2 title "flow rate"
