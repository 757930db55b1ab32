// What a drag does in the Depth view: a small bar over the canvas.
#pragma once

#include "scene/scene.h"

#include <QFrame>
#include <QToolButton>

#include <optional>

namespace lampblack
{

/// The name of a brush, for people.
QString nameOf(Brush brush);

/// A child of the canvas, in its upper left corner.
class BrushBar : public QFrame
{
    Q_OBJECT

public:
    explicit BrushBar(QWidget* canvas);

    /// No value: a drag draws a step.
    std::optional<Brush> brush() const { return mBrush; }
    void setBrush(std::optional<Brush> brush);

Q_SIGNALS:
    void brushChosen(std::optional<lampblack::Brush> brush);

private:
    void addButton(const char* name, const QString& text, const QString& tip, std::optional<Brush> brush);

    std::optional<Brush> mBrush;
    QVector<QPair<QToolButton*, std::optional<Brush>>> mButtons;
};

} // namespace lampblack
