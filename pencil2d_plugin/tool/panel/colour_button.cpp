#include "tool/panel/colour_button.h"

#include "tool/gesture.h"

#include <QMainWindow>
#include <QPainter>
#include <QStyleOptionToolButton>

#include <limits>

namespace lampblack
{

ColourButton::ColourButton(const QString& name, const QString& label, QWidget* parent) : QToolButton(parent)
{
    setObjectName(name);
    setAccessibleName(label);
    setToolTip(
        tr("%1. While its dialog is open, Pencil2D's palette and colour box choose it too.").arg(label));
    setFixedSize(44, 22);
    setFocusPolicy(Qt::StrongFocus);
    connect(this, &QToolButton::clicked, this, &ColourButton::openDialog);
}

void ColourButton::setColour(const QColor& colour)
{
    mColour = colour;
    setAccessibleDescription(colour.name());
    update();
}

void ColourButton::choose(const QColor& colour)
{
    if (mDialog)
        mDialog->setCurrentColor(QColor(colour.rgb()));
}

void ColourButton::closeDialog()
{
    if (mDialog)
        mDialog->accept();
    mDialog.clear();
}

void ColourButton::openDialog()
{
    if (mDialog)
    {
        mDialog->raise();
        return;
    }
    const QColor before = mColour;
    const int gesture = newGesture();
    mDialog = new QColorDialog(before, this);
    mDialog->setObjectName(objectName() + QStringLiteral(".dialog"));
    mDialog->setWindowTitle(accessibleName());
    mDialog->setAttribute(Qt::WA_DeleteOnClose);
    const auto applyColour = [this, gesture](const QColor& colour)
    {
        if (!colour.isValid())
            return;
        setColour(colour);
        Q_EMIT edited(colour, gesture);
    };
    connect(mDialog, &QColorDialog::currentColorChanged, this, applyColour);
    connect(mDialog, &QColorDialog::rejected, this, [applyColour, before] { applyColour(before); });
    mDialog->adjustSize();
    mDialog->move(placeBeside(mDialog->size(), *this));
    mDialog->show();
}

QPoint placeBeside(const QSize& size, const QWidget& widget)
{
    const auto* window = qobject_cast<const QMainWindow*>(widget.window());
    if (window == nullptr || window->centralWidget() == nullptr)
        return widget.mapToGlobal(QPoint(0, widget.height()));
    const QWidget& canvas = *window->centralWidget();
    const QRect covered(canvas.mapToGlobal(QPoint()), canvas.size());
    const QRect room = QRect(window->mapToGlobal(QPoint()), window->size());
    QPoint best;
    int least = std::numeric_limits<int>::max();
    for (const int x : {room.right() - size.width(), room.left()})
    {
        for (const int y : {room.bottom() - size.height(), room.top()})
        {
            const QRect overlap = QRect(QPoint(x, y), size) & covered;
            const int pixels = overlap.width() * overlap.height();
            if (pixels < least)
            {
                least = pixels;
                best = QPoint(x, y);
            }
        }
    }
    return best;
}

void ColourButton::paintEvent(QPaintEvent*)
{
    QStyleOptionToolButton option;
    initStyleOption(&option);
    QPainter painter(this);
    style()->drawComplexControl(QStyle::CC_ToolButton, &option, &painter, this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QColor(0, 0, 0, 110));
    painter.setBrush(isEnabled() ? mColour : palette().color(QPalette::Mid));
    painter.drawRoundedRect(QRectF(rect()).adjusted(4.5, 4.5, -4.5, -4.5), 2, 2);
}

} // namespace lampblack
