# SPDX-License-Identifier: GPL-2.0-or-later
"""The picture of doc/view.md: yade -x doc/view_picture.py PICTURE.png"""
import sys
import tempfile

from PyQt5.QtGui import QImage
from PyQt5.QtWidgets import QApplication
from softgrain import *
from yade import qt

O.materials.append(NeoHookeanMat(density=1000, frictionAngle=0.3, label="gel"))
O.materials.append(FrictMat(frictionAngle=0.1, label="steel"))
width = 8e-3
grains, height = softCloud(width, count=15, diameters=(1.4e-3, 2.4e-3), solidFraction=0.65, material="gel")
O.bodies.append(grains)
left, right, bottom, top = O.bodies.append(softBox(width, height, "steel"))
O.bodies[top].state.vel = (0, -1, 0)
for wall in (left, right, bottom, top):
    O.bodies[wall].mask = 2
for grain in grains:
    grain.mask = 3                      # touch the walls; alone share a bit with the mask below
shots = tempfile.TemporaryDirectory()
O.engines = softEngines(more=[SnapshotEngine(fileBase=shots.name + "/", iterPeriod=3000, initRun=False)])

Gl1_SoftGrain.field = "vonMises"
view = qt.View()
view.screenSize = (900, 620)
view.orthographic, view.axes, view.scale, view.timeDisp = True, False, False, ""
qt.Renderer().bgColor, qt.Renderer().mask = (1, 1, 1), 1
view.fitAABB((0, 0, 0), (width, 0.8 * height, 0))
O.run(3001)
while O.running:
    QApplication.processEvents()        # a script that ends at once leaves that to YADE
QImage(shots.name + "/00000.png").save(sys.argv[1], "PNG", 0)  # smaller
