"""Measure the neutral face on a head mesh: the command that made the shipped numbers.

    python -m pdeface.template.build HEAD_FOLDER

It closes the eyes, lips and nostrils of the mesh (:mod:`.closing`), cuts a face out of it in
front of the ears (:mod:`.cutting`), flattens that (:mod:`.chart`), lays smooth rows and columns
on its features (:mod:`.rows`, :mod:`.parameterisation`), samples a dense uv grid, and fits the
boundary curves of every level to the samples (:func:`pdeface.pde.fit.fit_curves`).
"""
