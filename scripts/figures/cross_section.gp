# Cross-section of the portrait at tau_i = 8 (compare Huba2022, Figure 12): IAE_w + IAE_d as colour, the admissible
# settings as rings, the optimum as a star. White: unstable.
set datafile separator ","
set terminal svg size 900,640 font "Helvetica,15" background "white"
set output "demo/cross_section.svg"
set title "DIPDT, ideal PID, tau_i = 8: how fast, and where the shapes are nearly ideal" noenhanced
set xlabel "kappa = K_c K T_d^2"
set ylabel "delta = K_d K T_d"
set cblabel "IAE_w + IAE_d (normalised, log scale)"
set logscale cb
set palette defined (0 "#fde725", 1 "#5ec962", 2 "#21918c", 3 "#3b528b", 4 "#440154")
set style fill solid noborder
set key outside bottom center horizontal
set xrange [0.04:0.36]
set yrange [0.32:1.08]
plot "demo/slice.csv" using "kappa":"delta":(0.005):(0.025):"objective" with boxxyerror lc palette notitle, \
     "demo/admissible.csv" using "kappa":"delta" with points pt 6 ps 1.8 lw 2 lc rgb "black" title "admissible under (46)", \
     "demo/admissible.csv" using "kappa":"delta" every ::0::0 with points pt 3 ps 2.4 lw 3 lc rgb "red" title "optimum (47)"
