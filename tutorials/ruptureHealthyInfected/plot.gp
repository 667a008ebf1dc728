# Greatest tension, area of the holes and haemolysis index of each cell over strain. Writes postProcessing/comparison.png.
set terminal pngcairo size 1200,400 font ",11"
set output 'postProcessing/comparison.png'
set datafile separator comma
set datafile columnheaders
file(i) = 'postProcessing/rupture/'.word(cells, i).'.csv'
cells = 'healthy infected'
set xlabel 'strain'; set key top left; set xrange [] noextend; set yrange [0:*]; set offsets 0, 0, graph 0.1, 0
set multiplot layout 1,3
set ylabel 'greatest principal tension [uN/m]'
plot for [i=1:2] file(i) using 'strain':(1e6*column('maxTension_N_m')) with lines lw 2 lc i title word(cells, i)
set ylabel 'area of the holes [um^2]'
plot for [i=1:2] file(i) using 'strain':(1e12*column('holeArea_m2')) with lines lw 2 lc i title word(cells, i)
set ylabel 'haemolysis index [%]'
plot for [i=1:2] file(i) using 'strain':(column('haemolysisIndex_percent')) with lines lw 2 lc i title word(cells, i)
unset multiplot
