#include "tool/panel/section.h"

namespace lampblack
{

Section::Section(const QString& name, const QString& title, bool open, QWidget* parent)
    : QWidget(parent), mHeading(new QToolButton(this)), mContent(new QWidget(this)),
      mBody(new QVBoxLayout(mContent))
{
    mHeading->setObjectName(name);
    mHeading->setText(title);
    mHeading->setAutoRaise(true);
    mHeading->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    mHeading->setIconSize(QSize(10, 10));
    mHeading->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    mHeading->setFocusPolicy(Qt::TabFocus);
    QFont bold = mHeading->font();
    bold.setBold(true);
    mHeading->setFont(bold);
    mBody->setContentsMargins(4, 0, 0, 4);
    mBody->setSpacing(3);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(2);
    column->addWidget(mHeading);
    column->addWidget(mContent);
    connect(mHeading, &QToolButton::clicked, this,
            [this]
            {
                setOpen(!mOpen);
                Q_EMIT toggled(mOpen);
            });
    setOpen(open);
}

void Section::setOpen(bool open)
{
    mOpen = open;
    mHeading->setArrowType(open ? Qt::DownArrow : Qt::RightArrow);
    mContent->setVisible(open);
}

} // namespace lampblack
