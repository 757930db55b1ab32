#include "tool/depth/brush_bar.h"

#include <QHBoxLayout>

namespace lampblack
{

namespace
{

constexpr int Margin = 6; // pixels

} // namespace

QString nameOf(Brush brush)
{
    switch (brush)
    {
    case Brush::Bump:
        return BrushBar::tr("Bump");
    case Brush::Dent:
        return BrushBar::tr("Dent");
    case Brush::Turn:
        return BrushBar::tr("Turn");
    case Brush::Round:
        return BrushBar::tr("Round");
    case Brush::Hollow:
        return BrushBar::tr("Hollow");
    }
    return {};
}

BrushBar::BrushBar(QWidget* canvas) : QFrame(canvas)
{
    setObjectName(QStringLiteral("lampblack.brush_bar"));
    setFrameShape(QFrame::StyledPanel);
    setAutoFillBackground(true);
    setCursor(Qt::ArrowCursor);
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(2, 2, 2, 2);
    row->setSpacing(1);
    addButton("step", tr("Step"),
              tr("Correct what is in front: click a line, or drag where a step is missing"), {});
    addButton("bump", nameOf(Brush::Bump), tr("Drag or click: the surface rises under the brush"),
              Brush::Bump);
    addButton("dent", nameOf(Brush::Dent), tr("Drag or click: the surface sinks under the brush"),
              Brush::Dent);
    addButton("turn", nameOf(Brush::Turn), tr("Drag: the surface turns to where the stroke goes"),
              Brush::Turn);
    addButton("round", nameOf(Brush::Round), tr("Drag where the surface was wrongly taken for hollow"),
              Brush::Round);
    addButton("hollow", nameOf(Brush::Hollow), tr("Drag along a fold or a hollow that was taken for round"),
              Brush::Hollow);
    setBrush({});
    adjustSize();
    move(Margin, Margin);
    hide();
}

void BrushBar::addButton(const char* name, const QString& text, const QString& tip,
                         std::optional<Brush> brush)
{
    auto* button = new QToolButton(this);
    button->setObjectName(QStringLiteral("lampblack.brush_bar.") + QLatin1String(name));
    button->setText(text);
    button->setToolTip(tip);
    button->setCheckable(true);
    button->setAutoRaise(true);
    button->setFocusPolicy(Qt::NoFocus);
    connect(button, &QToolButton::clicked, this,
            [this, brush]
            {
                setBrush(brush);
                Q_EMIT brushChosen(brush);
            });
    layout()->addWidget(button);
    mButtons.append({button, brush});
}

void BrushBar::setBrush(std::optional<Brush> brush)
{
    mBrush = brush;
    for (const auto& entry : qAsConst(mButtons))
        entry.first->setChecked(entry.second == brush);
}

} // namespace lampblack
