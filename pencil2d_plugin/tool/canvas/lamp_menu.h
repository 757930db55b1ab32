// The menu under the right button.
#pragma once

#include "scene/scene_document.h"

#include <QMenu>
#include <QPointF>

namespace lampblack
{

/// What can be done at a place of the canvas. Rebuilt each time that it opens.
class LampMenu : public QMenu
{
    Q_OBJECT

public:
    LampMenu(SceneDocument& document, QWidget* parent);

    /// `canvas` is the place in canvas pixels; `light` the light there, or -1; `colour` the flat colour
    /// there, "#rrggbb" or empty.
    void openAt(const QPointF& canvas, const QPoint& global, int light, const QString& colour);

Q_SIGNALS:
    void editMaterialRequested(const QString& colour);

private:
    void fill(const QPointF& canvas, int light, const QString& colour);
    void fillMaterial(const QString& colour);
    QAction* add(const char* name, const QString& text, const std::function<void()>& act);

    SceneDocument& mDocument;
};

/// `scene` with its lights, ambient light and floor as a new project has them.
Scene withLightingReset(Scene scene);

/// A square of a colour with a thin edge, for menus and buttons.
QIcon colourIcon(const QColor& colour, int side, double pixelRatio);

} // namespace lampblack
