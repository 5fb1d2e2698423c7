# Cross-section of the portrait at tau_i = 8 (compare Huba2022, Figure 12): IAE_w + IAE_d as colour, the admissible
# settings as rings, the optimum as a star.
set datafile separator ","
set terminal svg size 900,640 font "Helvetica,15" background "white"
set output "demo/cross_section.svg"
set title "DIPDT, ideal PID, {/Symbol t}_i = 8: speed, and where the shapes are nearly ideal"
set xlabel "{/Symbol k} = K_c K T_d^2"
set ylabel "{/Symbol d} = K_d K T_d"
set cblabel "IAE_w + IAE_d (normalised, log scale)"
set logscale cb
set palette viridis negative
set key outside bottom center horizontal
set xrange [0.04:0.36]
set yrange [0.32:1.08]
plot "demo/slice.csv" using "kappa":"delta":"objective" with points pt 5 ps 1.9 lc palette notitle, \
     "demo/admissible.csv" using "kappa":"delta" with points pt 6 ps 1.4 lw 2 lc rgb "white" title "", \
     "demo/admissible.csv" using "kappa":"delta" with points pt 6 ps 1.8 lw 1.5 lc rgb "black" title "admissible under (46)", \
     "demo/admissible.csv" using "kappa":"delta" every ::1::1 with points pt 3 ps 2.4 lw 3 lc rgb "red" title "optimum (47)"
