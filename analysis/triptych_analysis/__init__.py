"""The statistics of Bruder, Müller, Frey and Ertl, "On Evaluating Runtime Performance of Interactive
Visualizations", computed from the tables of `triptych export`, for times and for instructions."""
