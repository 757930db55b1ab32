#include "tool/panel/colour_button.h"

#include "tool/gesture.h"

#include <QPainter>
#include <QStyleOptionToolButton>

namespace lampblack
{

ColourButton::ColourButton(const QString& name, const QString& label, QWidget* parent) : QToolButton(parent)
{
    setObjectName(name);
    setAccessibleName(label);
    setToolTip(label);
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
    mDialog->show();
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
