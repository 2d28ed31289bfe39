# SPDX-License-Identifier: GPL-2.0-or-later
"""The picture of doc/paraview.md, drawn by ParaView's own Python: pvpython paraview_picture.py SERIES.pvd PICTURE.png"""
import sys

from paraview.simple import (ColorBy, CreateView, ExtractBlock, GetActiveCamera, GetAnimationScene, GetScalarBar, Glyph, OpenDataFile,
                             ResetCamera, SaveScreenshot, Show)

RED, GREY, BLACK = [0.8, 0, 0], [0.3, 0.3, 0.3], [0, 0, 0]
LONGEST = 1e-3      # line of a force [m]

scene = OpenDataFile(sys.argv[1])
view = CreateView("RenderView", ViewSize=[1000, 700], Background=[1, 1, 1], UseColorPaletteForBackground=False,
                  OrientationAxesVisibility=False, CameraParallelProjection=True)
moments = GetAnimationScene()
moments.UpdateAnimationUsingDataTimeSteps()
moments.GoToLast()


def block(name):
    return ExtractBlock(Input=scene, Selectors=["/Root/" + name])


def show(data, colour, **how):
    return Show(data, view, AmbientColor=colour, DiffuseColor=colour, ColorArrayName=[None, ""], **how)


show(block("grains"), GREY, Representation="Wireframe")
show(block("rigid"), BLACK, LineWidth=3)
points = show(block("points"), BLACK, Representation="Point Gaussian", GaussianRadius=4e-5, ShaderPreset="Plain circle")
ColorBy(points, ("POINTS", "vonMises"))
points.RescaleTransferFunctionToDataRange(False, True)
points.LookupTable.ApplyPreset("Viridis (matplotlib)", True)
points.SetScalarBarVisibility(view, True)
bar = GetScalarBar(points.LookupTable, view)
bar.Title, bar.ComponentTitle, bar.TitleColor, bar.LabelColor = "von Mises stress [Pa]", "", BLACK, BLACK
contacts = block("contacts")
contacts.UpdatePipeline(moments.EndTime)
largest = contacts.PointData["normalForce"].GetRange()[1]
show(Glyph(Input=contacts, GlyphType="Line", GlyphMode="All Points", OrientationArray=["POINTS", "force"],
           ScaleArray=["POINTS", "normalForce"], ScaleFactor=LONGEST / largest), RED, LineWidth=2)
ResetCamera(view)
GetActiveCamera().Zoom(1.2)
SaveScreenshot(sys.argv[2], view, CompressionLevel="9")
