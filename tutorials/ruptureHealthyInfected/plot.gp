# Greatest tension, area of the holes and haemolysis index of each cell over strain. Writes postProcessing/comparison.png.
set terminal pngcairo size 1200,400 font ",11"
set output 'postProcessing/comparison.png'
set datafile separator comma
files(cell) = system("ls -d postProcessing/rupture/*/".cell.".csv | sort -t/ -k3 -g")
cells = 'healthy infected'
set xlabel 'strain'; set key top left; set yrange [0:*]; set offsets 0, 0, graph 0.1, 0
number(f, name) = int(system("head -n 1 ".f." | tr , '\n' | grep -nx ".name." | cut -d: -f1"))
set multiplot layout 1,3
set ylabel 'greatest principal tension [uN/m]'
plot for [i=1:2] for [f in files(word(cells, i))] f using 2:(1e6*column(number(f, 'maxTension_N_m'))) skip 1 with lines lw 2 lc i title word(cells, i)
set ylabel 'area of the holes [um^2]'
plot for [i=1:2] for [f in files(word(cells, i))] f using 2:(1e12*column(number(f, 'holeArea_m2'))) skip 1 with lines lw 2 lc i title word(cells, i)
set ylabel 'haemolysis index [%]'
plot for [i=1:2] for [f in files(word(cells, i))] f using 2:(column(number(f, 'haemolysisIndex_percent'))) skip 1 with lines lw 2 lc i title word(cells, i)
unset multiplot
