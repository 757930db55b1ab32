// The parts of Pencil2D's window that we hold on to, found by class and object name.
#pragma once

#include "host/host.h"

#include <QMainWindow>
#include <QPointer>
#include <QToolButton>

namespace lampblack
{

/// What was found; anything may be null on another version of the program.
struct Parts
{
    QPointer<QMainWindow> window;
    QPointer<QWidget> canvas;
    QPointer<QWidget> background; ///< paints the paper beneath the canvas
    QPointer<QObject> editor;
    QPointer<QObject> layers;
    QPointer<QObject> tools;
    QPointer<QObject> view;
    QPointer<QObject> playback;
    QPointer<QObject> preferences;
    QPointer<QDockWidget> palette;
    QPointer<QDockWidget> options;
    QPointer<QWidget> timeControls;
    QPointer<QWidget> layerCells; ///< names and eyes, beside the tracks
    QPointer<QWidget> trackCells;

    QAction* action(const char* name) const;
    QVector<QToolButton*> toolButtons() const; ///< checkable ones of the palette
};

/// The main window of Pencil2D among the shown windows of this process, or null.
QMainWindow* findMainWindow();

Parts findParts(QMainWindow* window);

/// One sentence that says why this build does not let us; empty if it does.
QString whyNot(const Parts& parts, Host::Ability ability);

/// Whether `object` declares this signal or slot, named as moc does: "scrubbed(int)".
bool has(const QObject* object, const char* signature);

/// Whether `object` is of the class `name`, or of one derived from it.
bool isClass(const QObject* object, const char* name);

} // namespace lampblack
