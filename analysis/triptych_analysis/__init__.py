"""The statistics of Bruder, Müller, Frey and Ertl, "On Evaluating Runtime Performance of Interactive
Visualizations", over the tables of `triptych export`: of times, and of instructions beside them."""
